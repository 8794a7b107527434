#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "hand/skin.h"
#include "io/hand/result_table.h"
#include "io/lcm/lcm_log_reader.h"
#include "io/recording/recording_writer.h"
#include "support/child_process.h"
#include "support/painted_hand.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// Tests `barehand track` on a recording of a wall without a hand. All of its frames refer to the same small image.
class TrackRun : public ::testing::Test {
 protected:
  void SetUp() override {
    auto writer = RecordingWriter::create(folder_);
    ASSERT_TRUE(writer) << writer.error().message();
    RgbdFrame frame;
    frame.utime = 1'000'000;
    frame.camera = {64, 48, 60, 60, 31.5, 23.5};
    frame.depth.reset(64, 48, 800);
    ASSERT_TRUE(writer->write(frame) && writer->finish());
  }

  /// Records six frames of a hand in front of a wall. The hand rotates slightly.
  void record_hand() {
    fs::remove_all(folder_);
    auto writer = RecordingWriter::create(folder_);
    ASSERT_TRUE(writer) << writer.error().message();
    const auto profile = test::adult_hand();
    const Skin skin = make_blended_skin(*profile, 0.004);
    for (int i = 0; i < 6; ++i) {
      const auto observation = test::observe_skin(skin, test::facing_pose(*profile, 0.5 + 0.003 * i, 0.15 + 0.05 * i));
      RgbdFrame frame = *observation->frame;
      frame.utime = 1'000'000 + 33'333 * i;
      frame.depth_unit = 0.0001;
      frame.depth.reset(frame.camera.width, frame.camera.height);
      for (std::size_t k = 0; k < frame.depth.size(); ++k)
        frame.depth[k] = static_cast<std::uint16_t>(observation->depth[k] / frame.depth_unit);
      ASSERT_TRUE(writer->write(frame));
    }
    ASSERT_TRUE(writer->finish());
  }
  void repeat(int frames) {
    std::ofstream list(folder_ + "/depth.txt");
    for (int i = 1; i <= frames; ++i) list << i << ".0 depth/000000.png\n";
  }
  std::vector<std::string> track(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {BAREHAND_PROGRAM,
                                          "track",
                                          "--source",
                                          "folder:" + folder_,
                                          "--no-publish",
                                          "--result",
                                          folder_ + "/result.csv",
                                          "--states-log",
                                          folder_ + "/states.lcmlog",
                                          "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// Number of frames in the states log, which must not be damaged.
  std::size_t logged_frames() const {
    const auto log = LcmLogReader::open(folder_ + "/states.lcmlog");
    EXPECT_TRUE(log) << log.error().message();
    if (!log) return 0;
    EXPECT_EQ(log->damaged_bytes(), 0);
    std::size_t frames = 0;
    for (const LogEntry& entry : log->entries()) frames += entry.channel == "HAND_STATE";
    return frames;
  }

  std::string file_bytes(const std::string& name) const { return test::read_text(folder_ + name); }

  const test::TempFolder place_;
  const std::string folder_ = place_ / "recording";
};

TEST_F(TrackRun, FinishesARecordingWithASummary) {
  repeat(7);
  ChildProcess child(track({}));
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("7 published, 0 dropped, 0 failed"));
  EXPECT_THAT(child.output(), HasSubstr("searched for in 7"));
  EXPECT_EQ(logged_frames(), 7u);
  const auto table = read_table(folder_ + "/result.csv");
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_TRUE(table->frames.empty());
}

TEST_F(TrackRun, PlaysTheFramesThatWereAskedFor) {
  repeat(10);
  ChildProcess child(track({"--start", "8", "--step", "-3", "--inline", "--threads", "1"}));
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_EQ(logged_frames(), 3u);  // 8, 5, 2
}

TEST_F(TrackRun, GoesOnWithoutThePageWhereItsPortIsTaken) {
  repeat(5);
  ChildProcess first({BAREHAND_PROGRAM, "track", "--source", "lcm", "--lcm-url", "memq://", "--view=0"});
  const std::string page = "open http://localhost:";
  ASSERT_TRUE(first.wait_for(" in a browser")) << first.output();
  const std::string port = std::to_string(std::stoi(first.output().substr(first.output().find(page) + page.size())));
  ChildProcess second(track({"--view=" + port}));
  EXPECT_EQ(second.finish(), 0) << second.output();
  EXPECT_THAT(second.output(),
              AllOf(HasSubstr(port), HasSubstr("tracking goes on without the page"), HasSubstr("5 published")));
}

TEST_F(TrackRun, SkipsACorruptImageAndCountsIt) {
  repeat(5);
  std::ofstream(folder_ + "/depth/bad.png") << "no image";
  std::ofstream(folder_ + "/depth.txt", std::ios::app) << "6.0 depth/bad.png\n7.0 depth/000000.png\n";
  ChildProcess child(track({}));
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("depth/bad.png"));
  EXPECT_THAT(child.output(), HasSubstr("6 published, 0 dropped, 0 failed; 1 unreadable"));
}

TEST_F(TrackRun, CtrlCKeepsWhatWasTrackedAndIsExitCode130) {
  repeat(1'000'000);
  for (const bool inline_stages : {false, true}) {
    ChildProcess child(
        track(inline_stages ? std::vector<std::string>{"--health", "--inline"} : std::vector<std::string>{"--health"}));
    ASSERT_TRUE(child.wait_for("captured ")) << child.output();  // the first report of progress
    child.signal(SIGINT);
    EXPECT_EQ(child.finish(), 130) << child.output();
    EXPECT_THAT(child.output(), HasSubstr("stopped by Ctrl-C"));
    EXPECT_GT(logged_frames(), 0u);
    EXPECT_THAT(child.output(), HasSubstr("): " + std::to_string(logged_frames()) + " published"));
  }
}

TEST_F(TrackRun, SigtermBeforeTheEndOfARecordingIsNoSuccess) {
  repeat(1'000'000);
  ChildProcess child(track({"--health"}));
  ASSERT_TRUE(child.wait_for("captured ")) << child.output();
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 130) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("stopped by SIGTERM"));
}

TEST_F(TrackRun, SigtermStopsADaemonThatWaitsForFramesInOrder) {
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "lcm", "--lcm-url", "memq://"});
  ASSERT_TRUE(child.wait_for("tracking lcm:")) << child.output();
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("stopped by SIGTERM"));
}

TEST_F(TrackRun, FullDiskEndsTheRunAndKeepsWhatIsWritten) {
  repeat(1'000'000);
  // Files are limited to 32 or 64 KiB, depending on the shell. This replaces a full disk.
  std::string command = "trap '' XFSZ; ulimit -f 64; exec";
  for (const std::string& argument : track({})) command += " '" + argument + "'";
  ChildProcess child({"bash", "-c", command});
  EXPECT_EQ(child.finish(), 1) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("states.lcmlog"));
  EXPECT_THAT(child.output(), HasSubstr("frames in a row"));
  EXPECT_GT(logged_frames(), 0u);
}

TEST_F(TrackRun, SameBytesWhateverTheThreads) {
  record_hand();
  const std::string config = place_ / "quick.yaml";
  test::write_text(config, test::quick_config());
  std::vector<std::string> states, tables;
  for (const auto& how : std::vector<std::vector<std::string>>{
           {"--threads", "1", "--inline"}, {"--threads", "1"}, {"--threads", "3"}, {"--threads", "3", "--inline"}}) {
    std::vector<std::string> arguments = track(how);
    arguments.insert(arguments.end(), {"--config", config});
    ChildProcess child(arguments);
    ASSERT_EQ(child.finish(), 0) << child.output();
    EXPECT_THAT(child.output(), HasSubstr("tracked in 6 frames"));
    states.push_back(file_bytes("/states.lcmlog"));
    tables.push_back(file_bytes("/result.csv"));
  }
  ChildProcess other_seed(track({"--seed", "2", "--config", config}));
  ASSERT_EQ(other_seed.finish(), 0);
  for (std::size_t i = 1; i < states.size(); ++i) {
    EXPECT_EQ(states[i], states[0]) << i;
    EXPECT_EQ(tables[i], tables[0]) << i;
  }
  EXPECT_NE(file_bytes("/states.lcmlog"), states[0]) << "the seed has no effect: nothing was drawn";
}

TEST_F(TrackRun, SavesTheHandAsFittedToThePerson) {
  record_hand();
  ChildProcess child(track({"--save-hand", folder_ + "/mine.json"}));
  ASSERT_EQ(child.finish(), 0) << child.output();
  const auto hand = load_profile(folder_ + "/mine.json");
  ASSERT_TRUE(hand) << hand.error().message();
  EXPECT_EQ(hand->origin, ProfileOrigin::fitted);
  EXPECT_NE(hand->hand_length(), test::adult_hand()->hand_length());
}

TEST_F(TrackRun, SavesNoHandWhereNoneWasTracked) {
  ChildProcess child(track({"--save-hand", folder_ + "/mine.json"}));
  EXPECT_EQ(child.finish(), 1);
  EXPECT_THAT(child.output(), HasSubstr("no hand was tracked"));
  EXPECT_FALSE(fs::exists(folder_ + "/mine.json"));
}

TEST_F(TrackRun, WithoutAUsableGpuTheCpuTracks) {
  record_hand();
  const auto with_observer = [&](const std::string& observer) {
    const std::string file = folder_ + "/" + observer + ".yaml";
    test::write_text(file, test::replaced(test::quick_config(), "observer: \"auto\"", "observer: " + observer));
    return track({"--config", file});
  };
  ChildProcess cpu(with_observer("cpu"));
  ASSERT_EQ(cpu.finish(), 0) << cpu.output();
  EXPECT_THAT(cpu.output(), HasSubstr("tracked in 6 frames"));
  const std::string expected = file_bytes("/result.csv");
  for (const char* trouble : {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json",  // EGL without any driver
                              "LIBGL_DRIVERS_PATH=/nonexistent",                   // a driver that cannot start
                              "MESA_GLES_VERSION_OVERRIDE=3.0"}) {                 // an old GL
    std::vector<std::string> arguments = with_observer("egl");
    arguments.insert(arguments.begin(), {"env", trouble});
    ChildProcess child(arguments);
    EXPECT_EQ(child.finish(), 0) << child.output();
    EXPECT_THAT(child.output(), HasSubstr("samples are compared on the CPU, not on a GPU: ")) << trouble;
    EXPECT_EQ(file_bytes("/result.csv"), expected) << trouble;
  }
}

TEST_F(TrackRun, WhatIsReadIsNeverReplaced) {
  fs::create_directory(folder_ + "/rgb");
  test::write_text(folder_ + "/rgb/000000.jpg", "a picture");
  fs::create_directory_symlink(folder_ + "/rgb", place_ / "pictures");
  fs::create_hard_link(folder_ + "/depth/000000.png", place_ / "hard.csv");
  const std::string images = file_bytes("/depth/000000.png") + file_bytes("/rgb/000000.jpg");
  for (const auto& [option, output] :
       std::vector<std::pair<std::string, std::string>>{{"--overlay", folder_ + "/rgb"},
                                                        {"--overlay", place_ / "pictures"},
                                                        {"--overlay", folder_ + "/rgb/new"},
                                                        {"--overlay", folder_},
                                                        {"--overlay", place_.path()},
                                                        {"--result", folder_ + "/truth.csv"},
                                                        {"--result", folder_ + "/camera.json"},
                                                        {"--result", folder_ + "/depth/result.csv"},
                                                        {"--result", place_ / "hard.csv"},
                                                        {"--states-log", folder_ + "/depth.txt"},
                                                        {"--save-hand", place_ / "pictures/hand.json"}}) {
    ChildProcess child(
        {BAREHAND_PROGRAM, "track", "--source", "folder:" + folder_, "--no-publish", "--overwrite", option, output});
    EXPECT_EQ(child.finish(), 2) << option << " " << output << child.output();
    EXPECT_THAT(child.output(), AllOf(HasSubstr(option + " " + output), HasSubstr("source folder:" + folder_)));
  }
  EXPECT_EQ(file_bytes("/depth/000000.png") + file_bytes("/rgb/000000.jpg"), images);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 4) << "camera.json, depth, depth.txt, rgb";
}

TEST_F(TrackRun, TwoOutputsAreNotOneFile) {
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "folder:" + folder_, "--no-publish", "--result",
                      place_ / "out", "--states-log", folder_ + "/../out"});
  EXPECT_EQ(child.finish(), 2);
  EXPECT_THAT(child.output(), AllOf(HasSubstr("--states-log"), HasSubstr("--result"), HasSubstr("two names")));
  EXPECT_FALSE(fs::exists(place_ / "out"));
}

TEST_F(TrackRun, ExistingFilesAreReplacedOnlyIfAllowed) {
  const std::string table = place_ / "result.csv";
  test::write_text(table, "somebody's");
  std::vector<std::string> arguments = {BAREHAND_PROGRAM, "track",    "--source", "folder:" + folder_,
                                        "--no-publish",   "--result", table};
  ChildProcess refused(arguments);
  EXPECT_EQ(refused.finish(), 2);
  EXPECT_THAT(refused.output(), AllOf(HasSubstr("--result " + table), HasSubstr("--overwrite")));
  EXPECT_EQ(test::read_text(table), "somebody's");
  arguments.push_back("--overwrite");
  EXPECT_EQ(ChildProcess(arguments).finish(), 0);
  EXPECT_TRUE(read_table(table));
}

TEST_F(TrackRun, ALiveRunGoesOnBesideWhatIsThere) {
  const std::string table = place_ / "result.csv";
  test::write_text(table, "of yesterday");
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "sim:fist,live=true,frames=3,width=80,height=60",
                      "--no-publish", "--result", table});
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("exists already, writing " + (place_ / "result-2.csv")));
  EXPECT_EQ(test::read_text(table), "of yesterday");
  EXPECT_TRUE(read_table(place_ / "result-2.csv"));
}

TEST_F(TrackRun, PipesAndDevicesAreOutputs) {
  ChildProcess child({"bash", "-c",
                      std::string(BAREHAND_PROGRAM) + " track --source folder:" + folder_ +
                          " --no-publish --states-log /dev/null --overlay " + (place_ / "pictures") +
                          " --result >(cat >" + (place_ / "copy.csv") + "); wait $!"});
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_TRUE(read_table(place_ / "copy.csv"));
  EXPECT_TRUE(fs::exists(place_ / "pictures/000000.jpg"));
}

TEST_F(TrackRun, WhereNoFrameCouldBeReadNothingIsLeft) {
  fs::rename(folder_ + "/depth", place_ / "not_unpacked");
  ChildProcess child(track({"--overlay", folder_ + "/film.mp4"}));
  EXPECT_EQ(child.finish(), 1);
  EXPECT_THAT(child.output(), HasSubstr("nothing was tracked: of 1 frames 1 could not be read"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "camera.json and depth.txt";
}

TEST_F(TrackRun, MoreThanHalfOfTheFramesMustBeThere) {
  const auto with_missing = [&](int missing) {
    repeat(3);
    std::ofstream list(folder_ + "/depth.txt", std::ios::app);
    for (int i = 0; i < missing; ++i) list << 10 + i << ".0 depth/missing.png\n";
    list.close();
    ChildProcess child(track({}));
    return std::pair(child.finish(), child.output());
  };
  EXPECT_EQ(with_missing(3).first, 0);
  const auto [exit_code, output] = with_missing(4);
  EXPECT_EQ(exit_code, 1);
  EXPECT_THAT(output, HasSubstr("most frames are missing: of 7 frames 4 could not be read"));
  EXPECT_EQ(logged_frames(), 3u) << "what was read is kept";
}

TEST_F(TrackRun, FramesWithoutAHandAreAResult) {
  ChildProcess child(track({}));
  EXPECT_EQ(child.finish(), 0);
  EXPECT_THAT(child.output(), HasSubstr("no hand was found in any of 1 frames: is one in view, between 0.12 and"));
  EXPECT_TRUE(read_table(folder_ + "/result.csv")->frames.empty());
}

TEST_F(TrackRun, AKilledRunLeavesItsDraftsReadable) {
  repeat(100'000);
  ChildProcess child(track({}));
  const std::string draft = folder_ + "/states.lcmlog.unfinished";
  for (std::error_code not_yet; !fs::exists(draft) || fs::file_size(draft, not_yet) == 0;) std::this_thread::yield();
  child.signal(SIGKILL);
  EXPECT_EQ(child.finish(), 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(folder_ + "/result.csv"));
  EXPECT_TRUE(read_table(folder_ + "/result.csv.unfinished"));
  EXPECT_FALSE(LcmLogReader::open(draft)->entries().empty());
}

TEST_F(TrackRun, OutputThatCannotBeCreatedStopsTheStart) {
  ChildProcess child(
      {BAREHAND_PROGRAM, "track", "--source", "folder:" + folder_, "--no-publish", "--result", "/proc/result.csv"});
  EXPECT_EQ(child.finish(), 1);
  EXPECT_THAT(child.output(), HasSubstr("/proc/result.csv: cannot be written"));
  ChildProcess saving(track({"--save-hand", "/proc/mine.json"}));
  EXPECT_EQ(saving.finish(), 1);
  EXPECT_THAT(saving.output(), HasSubstr("/proc/mine.json: cannot be written"));
}

TEST_F(TrackRun, AMeshThatIsReadIsNotReplaced) {
  const std::string mesh = folder_ + "/block.obj",
                    content = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::ofstream(mesh) << content;
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "folder:" + folder_, "--no-publish", "--object", mesh,
                      "--result", mesh, "--overwrite"});
  EXPECT_EQ(child.finish(), 2);
  EXPECT_THAT(child.output(), HasSubstr("is the file of --object"));
  EXPECT_EQ(test::read_text(mesh), content);
}

TEST_F(TrackRun, BadHandAndPoseFilesAreExitCode2) {
  const std::string bad = folder_ + "/bad.json";
  std::ofstream(bad) << "{\"handedness\": \"right\", \"segments\": []}";
  for (const char* option : {"--hand", "--init"}) {
    ChildProcess child(track({option, bad}));
    EXPECT_EQ(child.finish(), 2) << option << child.output();
    EXPECT_THAT(child.output(), HasSubstr(bad));
    EXPECT_FALSE(fs::exists(folder_ + "/result.csv")) << "an output was touched before all input was checked";
  }
}

}  // namespace
}  // namespace barehand
