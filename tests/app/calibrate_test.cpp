#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "hand/profile.h"
#include "hand/skin.h"
#include "io/hand/hand_json.h"
#include "io/recording/recording_writer.h"
#include "support/adult_hand.h"
#include "support/child_process.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"
#include "web/web_client.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Calibrate : public ::testing::Test {
 protected:
  void SetUp() override { test::write_text(folder_ / "quick.yaml", test::quick_config()); }
  std::vector<std::string> calibrate(const std::string& source) const {
    return {BAREHAND_PROGRAM, "calibrate", "--source", source, "--config", folder_ / "quick.yaml", "--out", profile_};
  }

  const test::TempFolder folder_;
  const std::string profile_ = folder_ / "mine.json";
};

TEST_F(Calibrate, MakesAProfileAndSaysWhatWasNotShown) {
  ChildProcess child(calibrate("sim:scan,frames=20,width=320,height=240"));
  ASSERT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(),
              AllOf(HasSubstr("20 frames tracked"), HasSubstr("show the back of: palm, thumb_metacarpal"),
                    HasSubstr("bend and stretch: thumb_proximal")));
  const auto hand = load_profile(profile_);
  ASSERT_TRUE(hand) << hand.error().message();
  EXPECT_EQ(hand->origin, ProfileOrigin::fitted);
  EXPECT_NE(hand->hand_length(), test::adult_hand()->hand_length());
  EXPECT_FALSE(hand->scanned_skin);
  EXPECT_THAT(child.output(), HasSubstr("the scan was too short to measure the skin"));
}

TEST_F(Calibrate, GivesTheHandASkinOfItsOwn) {
  const std::string coarse = test::replaced(test::quick_config(), " skin_cell: 0.004\n", " skin_cell: 0.01\n");
  test::write_text(folder_ / "quick.yaml", coarse);
  ChildProcess child(calibrate("sim:scan,frames=100,width=320,height=240"));
  ASSERT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("skin and joints from 40 frames"));
  const auto hand = load_profile(profile_);
  ASSERT_TRUE(hand) << hand.error().message();
  EXPECT_EQ(hand->origin, ProfileOrigin::measured);
  ASSERT_TRUE(hand->scanned_skin);
  EXPECT_GT(hand->scanned_skin->vertices.size(), 300u);
}

TEST_F(Calibrate, CtrlCWhileTheSkinIsMeasuredKeepsTheFittedHand) {
  const std::string coarse = test::replaced(test::quick_config(), " skin_cell: 0.004\n", " skin_cell: 0.01\n");
  test::write_text(folder_ / "quick.yaml", coarse);
  ChildProcess child(calibrate("sim:scan,frames=100,width=320,height=240"));
  ASSERT_TRUE(child.wait_for("skin and joints: round 1 of")) << child.output();
  child.signal(SIGINT);
  EXPECT_EQ(child.finish(), 130);
  EXPECT_THAT(child.output(),
              AllOf(HasSubstr("stopped before the skin was measured"), HasSubstr("100 frames tracked")));
  const auto hand = load_profile(profile_);
  ASSERT_TRUE(hand) << hand.error().message();
  EXPECT_EQ(hand->origin, ProfileOrigin::fitted);
}

/// The scan in the next status message that contains one; null if the connection was closed.
nlohmann::json next_scan(test::SocketClient& client) {
  while (const auto text = client.text()) {
    const auto status = nlohmann::json::parse(*text);
    if (status["type"] == "status" && !status["scan"].is_null()) return status["scan"];
  }
  return nullptr;
}

TEST_F(Calibrate, CanBeFollowedOnThePage) {
  // Follow the scan as the page does, by the status messages.
  auto arguments = calibrate("sim:scan,frames=60,width=320,height=240");
  arguments.push_back("--view=0");
  ChildProcess child(arguments);
  ASSERT_TRUE(child.wait_for(" in a browser to see")) << child.output();
  const std::string url = "http://localhost:";
  test::SocketClient client(std::stoi(child.output().substr(child.output().find(url) + url.size())));
  std::vector<std::string> phases;
  nlohmann::json scan, last;
  for (scan = next_scan(client); !scan.is_null(); scan = next_scan(client)) {
    last = scan;
    if (phases.empty() || phases.back() != scan["phase"]) phases.push_back(scan["phase"]);
  }
  ASSERT_EQ(child.finish(), 0) << child.output();

  // The last status contains the lengths that the profile was saved with.
  EXPECT_THAT(phases, ElementsAre("showing", "measuring", "done"));
  const auto hand = load_profile(profile_);
  ASSERT_TRUE(hand) << hand.error().message();
  ASSERT_EQ(last["segments"].size(), static_cast<std::size_t>(kSegmentCount));
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto& segment = last["segments"][static_cast<std::size_t>(s)];
    EXPECT_EQ(segment["name"], kSegmentNames[s]);
    EXPECT_NEAR(segment["before"].get<double>(), test::adult_hand()->segments[s].length, 1e-6) << s;
    EXPECT_NEAR(segment["after"].get<double>(), hand->segments[s].length, 1e-6) << s;
  }
  EXPECT_EQ(last["frames"], 60);
  EXPECT_THAT(last["missing"].dump(), HasSubstr("show the back of: palm"));
  EXPECT_THAT(last["progress"].get<std::string>(), HasSubstr("Saved in " + profile_));
}

TEST_F(Calibrate, AMeasuredHandKeepsItsJointsAndGetsASkinOfWhatWasShown) {
  // A measured hand.
  HandProfile measured = *test::adult_hand();
  measured.origin = ProfileOrigin::measured;
  const std::string given = folder_ / "given.json";
  ASSERT_TRUE(save_profile(measured, given));

  // Scan it with only a few frames.
  auto arguments = calibrate("sim:scan,frames=90,width=320,height=240");
  arguments.insert(arguments.end(), {"--hand", given});
  ChildProcess child(arguments);
  ASSERT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("not seen well enough, so close to the initial hand"));

  // The joints are unchanged.
  const auto hand = load_profile(profile_);
  ASSERT_TRUE(hand && hand->scanned_skin);
  for (int s = 1; s < kSegmentCount; ++s)
    EXPECT_LT((hand->rest_relative(s).t - measured.rest_relative(s).t).norm(), 1e-5) << kSegmentNames[s];
}

TEST_F(Calibrate, WithoutAHandNothingIsSaved) {
  RgbdFrame wall;
  wall.utime = 1'000'000;
  wall.camera = {64, 48, 60, 60, 31.5, 23.5};
  wall.depth.reset(64, 48, 800);
  auto writer = RecordingWriter::create(folder_ / "wall");
  ASSERT_TRUE(writer && writer->write(wall) && writer->finish());
  ChildProcess child(calibrate("folder:" + (folder_ / "wall")));
  EXPECT_EQ(child.finish(), 1);
  EXPECT_THAT(child.output(), HasSubstr("no hand was tracked, nothing to save"));
  EXPECT_FALSE(std::filesystem::exists(profile_));
}

TEST_F(Calibrate, TheHandThatItStartsFromIsNotReplaced) {
  const std::string given = folder_ / "given.json";
  ASSERT_TRUE(save_profile(*test::adult_hand(), given));
  const std::string before = test::read_text(given);
  std::filesystem::create_symlink(given, profile_);
  auto arguments = calibrate("sim:scan,frames=2,width=80,height=60");
  arguments.insert(arguments.end(), {"--hand", given, "--overwrite"});
  ChildProcess child(arguments);
  EXPECT_EQ(child.finish(), 2);
  EXPECT_THAT(child.output(), AllOf(HasSubstr("--out " + profile_), HasSubstr("--hand " + given)));
  EXPECT_EQ(test::read_text(given), before);
}

TEST_F(Calibrate, AProfileIsReplacedOnlyIfAllowed) {
  test::write_text(profile_, "somebody's");
  ChildProcess child(calibrate("sim:scan,frames=2,width=80,height=60"));
  EXPECT_EQ(child.finish(), 2);
  EXPECT_THAT(child.output(), HasSubstr("--overwrite"));
  EXPECT_EQ(test::read_text(profile_), "somebody's");
}

TEST_F(Calibrate, RefusesWhatCannotBecomeAProfileBeforeItStarts) {
  // Each wrong option, and the reason that is given.
  for (const auto& [option, value, reason] :
       {std::tuple("--hand", std::string("both"), "names two hands"),
        {"--hand", folder_ / "nobody.json", "nobody.json"},
        {"--out", folder_ / "nowhere/mine.json", "No such file or directory"},
        {"--out", folder_.path(), "is a folder"},
        {"--out", folder_ / (std::string(300, 'x') + "/mine.json"), "name too long"}}) {
    // The command line with the option.
    auto arguments = calibrate("sim:scan");
    if (std::string(option) == "--out") arguments.resize(arguments.size() - 2);
    arguments.insert(arguments.end(), {option, value});

    // The program refuses it.
    ChildProcess child(arguments);
    EXPECT_EQ(child.finish(), 2) << child.output();
    EXPECT_THAT(child.output(), HasSubstr(reason));
  }
}

}  // namespace
}  // namespace barehand
