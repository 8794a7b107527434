// Tests the program in unusual environments: with closed descriptors, pipes without a reader, terminals that are closed
// while it runs, and limits.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <thread>

#include "io/hand/result_table.h"
#include "io/lcm/lcm_log_reader.h"
#include "support/barehand_program.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
namespace fs = std::filesystem;

constexpr const char* kHand = "sim:fist,width=160,height=120";

class Surroundings : public ::testing::Test {
 protected:
  Outcome script(const std::string& text) const { return barehand::script(folder_.path(), text); }
  /// Creates a recording of six frames, one of which cannot be read, so that the program prints a message.
  std::string recording() const {
    EXPECT_EQ(barehand({"sim", "fist,width=160,height=120,frames=6", "--out", folder_ / "take"}).exit_code, 0);
    fs::remove(folder_ / "take/depth/000003.png");
    test::write_text(folder_ / "quick.yaml", test::quick_config());
    return folder_ / "take";
  }
  /// Waits until the file of this name, or its draft (which a program writes first), is not empty.
  void wait_for_bytes(const std::string& name) const {
    const auto written = [&] {
      for (const auto& entry : fs::directory_iterator(folder_.path())) {
        std::error_code gone;
        if (entry.path().filename().string().starts_with(name) && entry.file_size(gone) > 0 && !gone) return true;
      }
      return false;
    };
    while (!written()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  static std::size_t events(const std::string& log) {
    const auto reader = LcmLogReader::open(log);
    if (!reader || reader->damaged_bytes() != 0) return 0;
    return reader->entries().size();
  }
  const test::TempFolder folder_;
};

TEST_F(Surroundings, MessagesNeverLandInDataWhicheverDescriptorsAreClosed) {
  recording();
  const std::string track =
      "$B track --source folder:$D/take --no-publish --config $D/quick.yaml --result $D/r.csv --states-log "
      "$D/s.lcmlog; "
      "rc=$?; cat $D/r.csv $D/s.lcmlog | md5sum > $D/$N; rm $D/r.csv $D/s.lcmlog; exit $rc";
  EXPECT_EQ(script("N=open; " + track).exit_code, 0);
  for (const std::string closed : {"0<&-", "1>&-", "2>&-", "0<&- 1>&-", "1>&- 2>&-", "0<&- 2>&-", "0<&- 1>&- 2>&-"}) {
    EXPECT_EQ(script("N=closed; exec " + closed + "; " + track).exit_code, 0) << closed;
    EXPECT_EQ(test::read_text(folder_ / "closed"), test::read_text(folder_ / "open")) << closed;
  }
}

/// A shell command that makes descriptor 3 a pipe without a reader.
const std::string kBrokenPipe = "exec 3> >(true); wait $!; ";

TEST_F(Surroundings, ARunGoesOnWhenNobodyReadsWhatItSays) {
  recording();
  const Outcome track = script(
      kBrokenPipe +
      "$B track --source folder:$D/take --no-publish --config $D/quick.yaml --result $D/r.csv --health >&3 2>&3");
  EXPECT_EQ(track.exit_code, 0);
  const auto table = read_table(folder_ / "r.csv");
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_FALSE(table->truncated);

  EXPECT_EQ(script(kBrokenPipe + "$B convert $D/take $D/take.lcmlog >&3 2>&3").exit_code, 0);
  EXPECT_EQ(events(folder_ / "take.lcmlog"), 5u);
  EXPECT_EQ(script(kBrokenPipe + "$B sim fist,width=160,height=120,frames=3 --out $D/again >&3 2>&3").exit_code, 0);
}

TEST_F(Surroundings, ACommandThatOnlyPrintsEndsWhenNobodyReads) {
  for (const char* command :
       {"track --print-config", "--help", "track --help", "sim --list", "listen --lcm-url memq://"}) {
    const Outcome outcome = script(kBrokenPipe + "$B " + command + " >&3");
    EXPECT_EQ(outcome.exit_code, 141) << command;
    EXPECT_THAT(outcome.output, AnyOf(IsEmpty(), StartsWith("listening on "))) << command;
  }
}

TEST_F(Surroundings, ACommandThatOnlyPrintsSaysThatItCannot) {
  const Outcome outcome = script("$B track --print-config >/dev/full");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("is the disk full?"));
}

TEST_F(Surroundings, ALimitOnTheSizeOfFilesIsAFullDisk) {
  const Outcome outcome = script("ulimit -f 40; $B record --source " + std::string(kHand) + " --out $D/a.lcmlog");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("File too large"));
  EXPECT_GT(events(folder_ / "a.lcmlog"), 0u);
}

TEST_F(Surroundings, HangupEndsARecordingInOrder) {
  ChildProcess child({BAREHAND_PROGRAM, "record", "--source", kHand + std::string(",live=true,loop=true"), "--out",
                      folder_ / "a.lcmlog"});
  wait_for_bytes("a.lcmlog");
  child.signal(SIGHUP);
  child.signal(SIGHUP);  // a terminal that is closed sends it twice
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("stopped"));
  EXPECT_GT(events(folder_ / "a.lcmlog"), 0u);
}

TEST_F(Surroundings, WhatAKilledRecorderLeftIsPartOfItsSet) {
  ChildProcess child({BAREHAND_PROGRAM, "record", "--source", kHand + std::string(",live=true,loop=true"), "--out",
                      folder_ / "a.lcmlog", "--max-size", "1GB"});
  wait_for_bytes("a-000001");
  const Outcome living = script("$B convert $D/a.lcmlog $D/living");
  EXPECT_EQ(living.exit_code, 2);
  EXPECT_THAT(living.output, HasSubstr("is still being written"));
  child.signal(SIGKILL);
  EXPECT_EQ(child.finish(), 128 + SIGKILL);
  fs::create_directory(folder_ / "set");
  EXPECT_EQ(script("mv $D/a-* $D/set").exit_code, 0);
  for (const std::string name : {"set/a.lcmlog", "set"}) {
    const Outcome killed = script("$B convert $D/" + name + " $D/out && rm -r $D/out");
    EXPECT_EQ(killed.exit_code, 0) << killed.output;
    EXPECT_THAT(killed.output, HasSubstr("lcmlog.unfinished: was left by a killed recorder"));
  }
}

/// These commands have nothing to save before they are finished, so the signal itself ends them.
TEST_F(Surroundings, CtrlCLeavesNoHalfFiguresOfEvalAndBench) {
  recording();
  ASSERT_EQ(mkfifo((folder_ / "r.csv").c_str(), 0600), 0);
  ChildProcess eval({BAREHAND_PROGRAM, "eval", "--result", folder_ / "r.csv", "--truth", folder_ / "take/truth.csv",
                     "--json", folder_ / "figures.json", "--plots", folder_ / "plots"});
  const int pipe = open((folder_ / "r.csv").c_str(), O_WRONLY);  // blocks until the program opens the table
  eval.signal(SIGINT);
  EXPECT_EQ(eval.finish(), 128 + SIGINT) << eval.output();
  close(pipe);

  ChildProcess bench({BAREHAND_PROGRAM, "bench", "--source", "folder:" + (folder_ / "take"), "--config",
                      folder_ / "quick.yaml", "--frames", "2", "--warm-up", "0", "--repeat", "1000", "--json",
                      folder_ / "bench.json"});
  ASSERT_TRUE(bench.wait_for("frames/s")) << bench.output();
  bench.signal(SIGINT);
  EXPECT_EQ(bench.finish(), 128 + SIGINT) << bench.output();

  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_.path())) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"quick.yaml", "r.csv", "take"}));
}

TEST_F(Surroundings, CtrlCBetweenTheStepsOfAnExperimentKeepsWhatIsFinished) {
  ChildProcess child({BAREHAND_PROGRAM, "experiment", "occlusion", "--configs", "default", "--frames", "3", "--set",
                      "width=160", "--set", "height=120", "--out", folder_ / "out"});
  ASSERT_TRUE(child.wait_for("1 of 7")) << child.output();
  child.signal(SIGINT);
  EXPECT_EQ(child.finish(), 130) << child.output();
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
    if (entry.path().extension() == ".csv") {
      const auto table = read_table(entry.path());
      EXPECT_TRUE(table && !table->truncated) << entry.path();
    }
  EXPECT_TRUE(fs::exists(folder_ / "out/recordings/occlusion_0/depth.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "out/occlusion.txt"));
}

TEST_F(Surroundings, HangupEndsATrackedRecordingInOrder) {
  recording();
  test::write_text(folder_ / "quick.yaml", test::quick_config());
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", kHand + std::string(",loop=true"), "--no-publish",
                      "--config", folder_ / "quick.yaml", "--states-log", folder_ / "s.lcmlog"});
  wait_for_bytes("s.lcmlog");
  child.signal(SIGHUP);
  EXPECT_EQ(child.finish(), 130) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("stopped by SIGHUP"));
  EXPECT_GT(events(folder_ / "s.lcmlog"), 0u);
}

TEST_F(Surroundings, AProgramUnderNohupOutlivesItsTerminal) {
  ChildProcess child({"sh", "-c",
                      "trap '' HUP; exec " BAREHAND_PROGRAM " record --source " + std::string(kHand) +
                          ",live=true,loop=true --frames 20 --out " + (folder_ / "a.lcmlog")});
  wait_for_bytes("a.lcmlog");
  child.signal(SIGHUP);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_EQ(events(folder_ / "a.lcmlog"), 20u);
}

}  // namespace
}  // namespace barehand
