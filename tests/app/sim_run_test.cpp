#include "app/sim/sim_run.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/shared/source_factory.h"
#include "drivers/lcm/lcm_log_source.h"
#include "io/hand/hand_json.h"
#include "io/hand/pose_json.h"
#include "io/hand/result_table.h"
#include "io/recording/recording.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

class SimRun : public testing::Test {
 protected:
  Result<std::int64_t> run(const std::string& spec, const std::string& out) {
    return run_sim({spec, out}, [](std::int64_t, std::int64_t) { return true; });
  }
  std::string path(const std::string& name) const { return folder_ / name; }

  test::TempFolder folder_;
};

TEST_F(SimRun, WritesARecordingWithTruthProfileAndStart) {
  const auto frames = run("fist,frames=3,width=160,height=120", path("fist"));
  ASSERT_TRUE(frames.has_value()) << frames.error().message();
  EXPECT_EQ(*frames, 3);

  // The recording.
  const auto recording = open_recording(path("fist"));
  ASSERT_TRUE(recording.has_value()) << recording.error().message();
  EXPECT_EQ(recording->entries.size(), 3u);
  EXPECT_EQ(recording->fps, 25);
  EXPECT_EQ(recording->depth_unit, 0.0001);

  // The truth.
  const auto truth = read_table(path("fist/truth.csv"));
  ASSERT_TRUE(truth.has_value()) << truth.error().message();
  ASSERT_EQ(truth->frames.size(), 3u);
  EXPECT_NEAR(truth->frames[1].timestamp, 1e-6 * recording->entries[1].utime, 1e-6);

  // The profile and the start.
  const auto profile = load_profile(path("fist/hand.json"));
  ASSERT_TRUE(profile.has_value()) << profile.error().message();
  const auto pose = load_pose(path("fist/start_pose.json"), *profile);
  ASSERT_TRUE(pose.has_value()) << pose.error().message();
  EXPECT_LT(((*pose)[kPalm].t - truth->frames[0].rows[kPalm].proximal).norm(), 1e-5);
}

TEST_F(SimRun, WritesTruthAndProfileOfBothHands) {
  // Both hands have their truth, and the left one comes later.
  const std::string spec = "two_hands,fps=10,frames=19,width=160,height=120";  // the left hand comes after 1.4 s
  ASSERT_TRUE(run(spec, path("two")).has_value());
  const auto right = read_table(path("two/truth.csv")), left = read_table(path("two/truth_left.csv"));
  ASSERT_TRUE(right.has_value());
  ASSERT_TRUE(left.has_value()) << left.error().message();
  EXPECT_EQ(right->frames.size(), 19u);
  ASSERT_FALSE(left->frames.empty());
  EXPECT_GT(left->frames.front().number, 10);
  EXPECT_EQ(left->frames.back().number, 18);
  EXPECT_GT(left->frames.back().rows[kPalm].proximal.x(), 0.1);
  EXPECT_LT(right->frames.back().rows[kPalm].proximal.x(), -0.1);
  EXPECT_TRUE(fs::exists(path("two/start_pose.json")));
  EXPECT_FALSE(fs::exists(path("two/start_pose_left.json"))) << "not in the first frame";

  const SystemClock clock;
  for (const std::string& source : {"folder:" + path("two"), "sim:" + spec}) {
    SourceRequest request;
    request.spec = source;
    const auto open = open_source(request, clock);
    ASSERT_TRUE(open.has_value()) << open.error().message();
    ASSERT_EQ(open->hands.size(), 2u) << source;
    EXPECT_EQ(open->hands[0].load()->handedness, Handedness::right);
    EXPECT_EQ(open->hands[1].load()->handedness, Handedness::left);
    EXPECT_THAT(open->hands[1].name, testing::HasSubstr("left"));
  }
}

/// The lines of a file.
std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

TEST_F(SimRun, WritesTheGraspedObjectAndItsContacts) {
  ASSERT_TRUE(run("grasp_mug,fps=1,width=160,height=120", path("mug")).has_value());

  // The object's pose, in every frame.
  const auto objects = lines_of(path("mug/objects.csv"));
  ASSERT_EQ(objects.size(), 1u + 7);
  EXPECT_EQ(objects[0], "utime,object,held,x,y,z,qw,qx,qy,qz");
  EXPECT_THAT(objects[1], testing::StartsWith("1000000,mug,0,"));
  EXPECT_THAT(objects[4], testing::StartsWith("4000000,mug,1,"));

  // The contacts of 16 segments, in every frame that shows the hand.
  const auto contacts = lines_of(path("mug/contacts.csv"));
  const auto truth = read_table(path("mug/truth.csv"));
  ASSERT_TRUE(truth.has_value());
  ASSERT_EQ(contacts.size(), 1 + kSegmentCount * truth->frames.size());
  EXPECT_EQ(contacts[0], "utime,segment,distance,x,y,z,nx,ny,nz");
  EXPECT_THAT(contacts[1], testing::StartsWith("1000000,palm,0."));
  EXPECT_FALSE(fs::exists(path("mug/contacts_left.csv")));

  // The class of the grasp.
  const auto grasps = lines_of(path("mug/grasps.csv"));
  ASSERT_EQ(grasps.size(), 1u + 7);
  EXPECT_EQ(grasps[1], "1000000,none");
  EXPECT_EQ(grasps[4], "4000000,wrap");

  // The mesh: a mug of 0.11 m, closed where its vertices were doubled.
  const auto mesh = lines_of(path("mug/mug.obj"));
  const auto vertices = std::count_if(mesh.begin(), mesh.end(), [](const auto& l) { return l.starts_with("v "); });
  const auto triangles = std::count_if(mesh.begin(), mesh.end(), [](const auto& l) { return l.starts_with("f "); });
  EXPECT_GT(vertices, 500);
  EXPECT_GT(triangles, 2 * vertices - 200);
}

TEST_F(SimRun, WritesNoObjectWhereNothingIsGrasped) {
  ASSERT_TRUE(run("open,frames=1,width=80,height=60", path("open")).has_value());
  EXPECT_FALSE(fs::exists(path("open/objects.csv")));
  EXPECT_FALSE(fs::exists(path("open/contacts.csv")));
}

TEST_F(SimRun, WritesTheSameDepthIntoALog) {
  // The same sequence as a folder and as a log.
  ASSERT_TRUE(run("open,frames=2,width=160,height=120", path("a")).has_value());
  const auto logged = run("open,frames=2,width=160,height=120", path("b.lcmlog"));
  ASSERT_TRUE(logged.has_value()) << logged.error().message();

  // The second frame of both.
  const auto recording = open_recording(path("a"));
  ASSERT_TRUE(recording.has_value());
  const auto from_folder = read_frame(*recording, 1);
  auto log = LcmLogSource::open(path("b.lcmlog"), {});
  ASSERT_TRUE(log.has_value()) << log.error().message();
  (void)(*log)->next(std::chrono::milliseconds(0));
  const SourceEvent event = (*log)->next(std::chrono::milliseconds(0));
  const auto* frame = std::get_if<FramePtr>(&event);
  ASSERT_TRUE(frame);
  ASSERT_TRUE(from_folder.has_value());

  // They agree, and the log has its files beside it.
  EXPECT_EQ((*frame)->utime, (*from_folder)->utime);
  EXPECT_TRUE(std::equal((*frame)->depth.data(), (*frame)->depth.data() + (*frame)->depth.size(),
                         (*from_folder)->depth.data()));
  EXPECT_TRUE(fs::exists(path("b.truth.csv")));
  EXPECT_TRUE(fs::exists(path("b.hand.json")));
}

TEST_F(SimRun, OverwritesNothing) {
  ASSERT_TRUE(run("open,frames=1,width=80,height=60", path("a")).has_value());
  const auto again = run("open,frames=1,width=80,height=60", path("a"));
  ASSERT_FALSE(again.has_value());
  EXPECT_THAT(again.error().message(), testing::HasSubstr("already"));
}

TEST_F(SimRun, StopsWhenToldAndLeavesACompleteRecording) {
  const auto frames =
      run_sim({"open,width=80,height=60", path("a")}, [](std::int64_t done, std::int64_t) { return done < 2; });
  ASSERT_TRUE(frames.has_value());
  EXPECT_EQ(*frames, 2);
  EXPECT_EQ(open_recording(path("a"))->entries.size(), 2u);
}

TEST_F(SimRun, RefusesWhatIsNoRecording) {
  EXPECT_FALSE(run("fist,live=true", path("a")).has_value());
  EXPECT_FALSE(run("dance", path("a")).has_value());
  EXPECT_FALSE(fs::exists(path("a")));
}

}  // namespace
}  // namespace barehand
