// Tests the commands `barehand record`, `convert` and `listen` as a user runs them.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/record/copy_frames.h"
#include "drivers/folder/folder_source.h"
#include "drivers/lcm/layouts.h"
#include "drivers/lcm/lcm_log_source.h"
#include "io/lcm/lcm_log_writer.h"
#include "support/barehand_program.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"
#include "tests/lcm/foreign_messages.h"
#include "tests/lcm/test_frames.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class CopyCommands : public testing::Test {
 protected:
  /// A folder of three frames.
  std::string recording() {
    auto writer = open_frame_writer(folder_ / "recording", {}).value();
    for (int number = 0; number < 3; ++number) EXPECT_TRUE(writer->write(test_frame(number)));
    return folder_ / "recording";
  }
  test::TempFolder folder_;
};

TEST_F(CopyCommands, ConvertGoesFromFolderToLogAndBack) {
  const Outcome there = barehand({"convert", recording(), folder_ / "a.lcmlog"});
  EXPECT_EQ(there.exit_code, 0) << there.output;
  EXPECT_THAT(there.output, HasSubstr("3 frames written"));
  EXPECT_EQ(barehand({"convert", folder_ / "a.lcmlog", folder_ / "back", "--step", "2"}).exit_code, 0);
  EXPECT_EQ(barehand({"convert", folder_ / "a.lcmlog", folder_ / "reversed", "--step", "-1"}).exit_code, 2)
      << "its times would decrease, so that it could not be played";
  EXPECT_EQ(FolderSource::open(folder_ / "back").value()->remaining(), 2);
}

TEST_F(CopyCommands, RecordTakesAnySource) {
  const Outcome outcome =
      barehand({"record", "--source", "folder:" + recording(), "--out", folder_ / "a.lcmlog", "--frames", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(LcmLogSource::open(folder_ / "a.lcmlog").value()->remaining(), 2);
}

TEST_F(CopyCommands, AFolderNotesTheRateThatIsKnown) {
  ASSERT_EQ(
      barehand({"record", "--source", "sim:fist,fps=20,width=64,height=48", "--frames", "4", "--out", folder_ / "a"})
          .exit_code,
      0);
  EXPECT_EQ(FolderSource::open(folder_ / "a").value()->recording().fps, 20);
  ASSERT_EQ(barehand({"convert", folder_ / "a", folder_ / "b", "--step", "2"}).exit_code, 0);
  EXPECT_EQ(FolderSource::open(folder_ / "b").value()->recording().fps, 10);
  ASSERT_EQ(barehand({"convert", folder_ / "a", folder_ / "a.lcmlog"}).exit_code, 0);
  ASSERT_EQ(barehand({"convert", folder_ / "a.lcmlog", folder_ / "d"}).exit_code, 0);
  EXPECT_EQ(FolderSource::open(folder_ / "d").value()->recording().fps, 20) << "by the times in the log";
  ASSERT_EQ(barehand({"convert", recording(), folder_ / "c"}).exit_code, 0);
  EXPECT_EQ(FolderSource::open(folder_ / "c").value()->recording().fps, 0) << "it is not known";
}

TEST_F(CopyCommands, NothingIsOverwrittenUnasked) {
  const std::string in = recording(), out = folder_ / "a.lcmlog";
  std::ofstream(out) << "precious";
  EXPECT_EQ(barehand({"convert", in, out}).exit_code, 2);
  EXPECT_EQ(std::filesystem::file_size(out), 8u);
  EXPECT_EQ(barehand({"convert", in, out, "--overwrite"}).exit_code, 0);
}

/// Expects that the program refuses the arguments with a message that contains all of `words`, and leaves the input
/// unchanged.
void expect_refused(const std::vector<std::string>& arguments, const std::string& input,
                    const std::vector<std::string>& words) {
  const std::string before = test::read_text(input);
  const Outcome outcome = barehand(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  for (const std::string& word : words) EXPECT_THAT(outcome.output, HasSubstr(word));
  EXPECT_EQ(test::read_text(input), before);
}

TEST_F(CopyCommands, TheSourceIsNeverReplaced) {
  const std::string in = folder_ / "a.lcmlog", hard = folder_ / "hard.lcmlog", soft = folder_ / "soft.lcmlog";
  ASSERT_EQ(barehand({"convert", recording(), in}).exit_code, 0);
  fs::create_hard_link(in, hard);
  fs::create_symlink("a.lcmlog", soft);
  for (const std::string& out : {in, folder_ / "./a.lcmlog", folder_ / "recording/../a.lcmlog", hard, soft}) {
    expect_refused({"convert", in, out, "--overwrite"}, in, {out, in, "never replaced"});
    expect_refused({"record", "--source", "log:" + in, "--out", out, "--overwrite"}, in, {out});
  }
  expect_refused({"convert", in, folder_.path()}, in, {"is or contains the source"});
}

TEST_F(CopyCommands, ASetOfLogsIsNotRecordedIntoItself) {
  fs::create_directory(folder_ / "set");
  const std::string part = folder_ / "set/take-000001-20260921T141320Z.lcmlog";
  ASSERT_EQ(barehand({"convert", recording(), part}).exit_code, 0);
  expect_refused({"record", "--source", "log:" + (folder_ / "set"), "--out", folder_ / "set/b.lcmlog"}, part,
                 {"would become a part of the source"});
  expect_refused({"record", "--source", "log:" + part, "--out", folder_ / "set/take.lcmlog", "--quota", "1MB"}, part,
                 {"names a set of logs that", part});
  expect_refused({"convert", folder_ / "set", folder_ / "set"}, part, {});
}

TEST_F(CopyCommands, WhereNothingCouldBeReadNothingIsLeft) {
  const std::string in = recording();
  fs::remove_all(in + "/depth");
  for (const std::string& out : {folder_ / "b.lcmlog", folder_ / "b"}) {
    const Outcome outcome = barehand({"convert", in, out});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("none of 3 frames"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "the recording alone";
  }
}

TEST_F(CopyCommands, FoldersThatWereMadeForNothingGoAgain) {
  const std::string in = recording();
  fs::remove_all(in + "/depth");
  fs::create_directory(folder_ / "mine");
  for (const std::string out : {"new/deeper/take.lcmlog", "mine/take.lcmlog", "new/deeper/folder"}) {
    std::vector<std::string> record = {"record", "--source", "folder:" + in, "--out", folder_ / out};
    if (out.ends_with(".lcmlog")) record.insert(record.end(), {"--max-size", "1GB"});
    EXPECT_EQ(barehand(record).exit_code, 1);
    EXPECT_FALSE(fs::exists(folder_ / "new")) << out;
    EXPECT_TRUE(fs::is_empty(folder_ / "mine")) << out;
  }
}

TEST_F(CopyCommands, MoreThanHalfOfTheFramesMustBeThere) {
  const std::string in = recording();
  fs::remove(in + "/depth/000001.png");
  EXPECT_EQ(barehand({"convert", in, folder_ / "b.lcmlog"}).exit_code, 0) << "one of three";
  fs::remove(in + "/depth/000002.png");
  const Outcome outcome = barehand({"convert", in, folder_ / "c.lcmlog"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("most frames are missing: 2 of 3"));
  EXPECT_EQ(LcmLogSource::open(folder_ / "c.lcmlog").value()->remaining(), 1) << "what was read is kept";
}

TEST_F(CopyCommands, IntrinsicsComeFromTheConfigurationUnlessTheyAreGiven) {
  const std::string log = folder_ / "kinect.lcmlog", config = folder_ / "config.yaml";
  auto writer = LcmLogWriter::create(log, false).value();
  ASSERT_TRUE(writer->send("KINECT", encode_message(kinect_message(test_frame(0), true)), 1));
  writer.reset();
  std::string text = test::read_text(BAREHAND_CONFIGS "/default.yaml");
  for (const char* key : {"fx", "fy", "cx", "cy"})  // the first key of this name belongs to foreign_camera
    text = test::replaced(text, std::string("  ") + key + ": 0\n", std::string("  ") + key + ": 3\n");
  test::write_text(config, text);
  const auto fx_after = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"convert", log, folder_ / "a.lcmlog", "--overwrite", "--config", config});
    const Outcome outcome = barehand(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const SourceEvent event = LcmLogSource::open(folder_ / "a.lcmlog").value()->next({});
    return std::get<FramePtr>(event)->camera.fx;
  };
  EXPECT_EQ(fx_after({}), 3);
  EXPECT_EQ(fx_after({"--fx", "5", "--fy", "5", "--cx", "2", "--cy", "2"}), 5);
  EXPECT_EQ(barehand({"convert", log, folder_ / "b.lcmlog", "--config", "/nonexistent.yaml"}).exit_code, 2);
}

TEST_F(CopyCommands, OniFilesAreReadButNotWritten) {
  const Outcome written = barehand({"convert", recording(), folder_ / "b.oni"});
  EXPECT_EQ(written.exit_code, 2);
  EXPECT_THAT(written.output, HasSubstr("ends in .oni, which is not written"));
  const Outcome read = barehand({"convert", "a.oni", folder_ / "b"});
  EXPECT_EQ(read.exit_code, 2);
  EXPECT_THAT(read.output, HasSubstr("a.oni: no such file"));
}

TEST_F(CopyCommands, AMistypedEndingMakesNeitherFileNorFolder) {
  const std::string in = recording();
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"convert", in, folder_ / "x.foo"},
        {"record", "--source", "folder:" + in, "--out", folder_ / "x.foo"},
        {"sim", "fist,frames=1", "--out", folder_ / "x.foo"},
        {"track", "--source", "folder:" + in, "--no-publish", "--mcap", folder_ / "x.foo"},
        {"track", "--source", "folder:" + in, "--no-publish", "--states-log", folder_ / "x.foo"},
        {"track", "--source", "folder:" + in, "--no-publish", "--overlay", folder_ / "x.foo"}}) {
    const Outcome outcome = barehand(command);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("ends in .foo, which is not written here (give a name that ends in ."));
    EXPECT_FALSE(fs::exists(folder_ / "x.foo")) << outcome.output;
  }
  EXPECT_EQ(barehand({"convert", in, folder_ / "x.foo/"}).exit_code, 0);
  EXPECT_EQ(FolderSource::open(folder_ / "x.foo").value()->remaining(), 3);
}

TEST_F(CopyCommands, AForeignFileIsRefusedClearly) {
  std::ofstream(folder_ / "a.txt") << "no log";
  const Outcome outcome = barehand({"convert", folder_ / "a.txt", folder_ / "b"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("is not an LCM log"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b"));
}

TEST_F(CopyCommands, APathThatCannotBeLookedAtIsRefusedClearly) {
  const Outcome outcome = barehand({"convert", std::string(300, 'x'), folder_ / "a.lcmlog"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("name too long"));
}

TEST_F(CopyCommands, AChannelThatNoReaderTakesIsRefused) {
  for (const std::string& channel : {std::string(), std::string(64, 'A')}) {
    const Outcome outcome = barehand({"convert", "anything", folder_ / "a.lcmlog", "--out-channel", channel});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr("channel names have 1 to 63 bytes"));
  }
}

TEST_F(CopyCommands, HalfOfTheIntrinsicsAreRefused) {
  const Outcome outcome = barehand({"convert", recording(), folder_ / "a.lcmlog", "--fx", "525", "--fy", "525"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("give all four"));
}

TEST_F(CopyCommands, AFullDiskFailsAndSaysWhatIsKept) {
  std::filesystem::create_symlink("/dev/full", folder_ / "full.lcmlog");
  const Outcome full = barehand({"convert", recording(), folder_ / "full.lcmlog", "--overwrite"});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.output, HasSubstr("No space left on device"));
  EXPECT_THAT(full.output, HasSubstr("0 frames written"));
}

TEST_F(CopyCommands, ControlCEndsALiveRecording) {
  ChildProcess child(
      {BAREHAND_PROGRAM, "record", "--source", "lcm", "--lcm-url", "memq://", "--out", folder_ / "a.lcmlog"});
  while (!std::filesystem::exists(folder_ / "a.lcmlog.unfinished")) std::this_thread::yield();
  child.signal(SIGINT);
  EXPECT_EQ(child.finish(), 130);
  EXPECT_THAT(child.output(), HasSubstr("stopped"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path())) << "no frame came";
}

TEST_F(CopyCommands, ARecordingThatIsStoppedIsNotDone) {
  ChildProcess child({BAREHAND_PROGRAM, "record", "--source", "sim:fist,loop=true,width=160,height=120", "--out",
                      folder_ / "a.lcmlog"});
  while (!std::filesystem::exists(folder_ / "a.lcmlog.unfinished")) std::this_thread::yield();
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 130) << child.output();
}

TEST_F(CopyCommands, ListenIsLive) {
  for (const auto& [signal, exit_code] : {std::pair(SIGTERM, 0), std::pair(SIGINT, 130)}) {
    ChildProcess child({BAREHAND_PROGRAM, "listen", "--lcm-url", "memq://"});
    ASSERT_TRUE(child.wait_for("listening on")) << child.output();
    child.signal(signal);
    EXPECT_EQ(child.finish(), exit_code) << child.output();
  }
}

TEST_F(CopyCommands, ListenRefusesAnImpossibleUrl) {
  EXPECT_EQ(barehand({"listen", "--lcm-url", "nonsense://"}).exit_code, 2);
}

}  // namespace
}  // namespace barehand
