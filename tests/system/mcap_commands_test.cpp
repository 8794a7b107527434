// Tests the commands `record`, `convert` and `track` with MCAP files as a user runs them.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "support/barehand_program.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class McapCommands : public testing::Test {
 protected:
  McapCommands() { test::write_text(folder_ / "quick.yaml", test::quick_config()); }
  /// A folder with a moving hand, as the program writes it.
  void make_recording() {
    const Outcome made =
        script(folder_.path(), "$B record --source sim:fist,width=160,height=120 --frames 6 --out $D/take");
    ASSERT_EQ(made.exit_code, 0) << made.output;
  }
  /// Expects that the shell commands in `text` succeed; otherwise prints their output.
  void expect_done(const std::string& text) const {
    const Outcome outcome = script(folder_.path(), "set -e; " + text);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  test::TempFolder folder_;
};

TEST_F(McapCommands, AFolderComesBackAsItWas) {
  make_recording();
  expect_done("$B convert $D/take $D/a.mcap; $B convert $D/a.mcap $D/back; diff -r $D/take $D/back");
  expect_done("$B convert $D/take $D/b.mcap; cmp $D/a.mcap $D/b.mcap");
}

TEST_F(McapCommands, TrackingSaysTheSameOfFolderLogAndMcap) {
  make_recording();
  expect_done(
      "track() { $B track --hand right --config $D/quick.yaml --no-publish --inline \"$@\"; }; "
      "$B convert $D/take $D/a.lcmlog; $B convert $D/take $D/a.mcap; "
      "track --source folder:$D/take --result $D/folder.csv --mcap $D/hands.mcap; "
      "track --source log:$D/a.lcmlog --result $D/log.csv; "
      "track --source log:$D/a.mcap --result $D/mcap.csv --mcap $D/again.mcap; "
      "track --source log:$D/hands.mcap --result $D/hands.csv; "
      "[ $(wc -l <$D/folder.csv) -gt 16 ]; cmp $D/folder.csv $D/log.csv; cmp $D/folder.csv $D/mcap.csv; "
      "cmp $D/folder.csv $D/hands.csv; cmp $D/hands.mcap $D/again.mcap");
}

TEST_F(McapCommands, JudgingTheStatesOfAnMcapFileSaysTheSameAsOfTheLog) {
  expect_done(
      "$B sim fist --frames 3 --set width=160 --set height=120 --out $D/s; "
      "$B track --source folder:$D/s --hand right --config $D/quick.yaml --no-publish --states-log $D/s.lcmlog --mcap "
      "$D/s.mcap; "
      "judge() { $B eval --truth $D/s/truth.csv --states $D/$1 --json $D/$1.json; }; judge s.lcmlog; judge s.mcap; "
      "grep -q errors_mm $D/s.mcap.json; cmp $D/s.lcmlog.json $D/s.mcap.json; "
      "$B convert $D/s $D/bare.mcap; ! judge bare.mcap 2>$D/said; grep -q 'holds no hand state.*--mcap' $D/said");
}

TEST_F(McapCommands, TheSimulatorWritesThemWithTheTruthBeside) {
  expect_done(
      "$B sim fist --frames 2 --set width=160 --set height=120 --out $D/s.mcap; [ -s $D/s.truth.csv ]; "
      "$B convert $D/s.mcap $D/s");
}

TEST_F(McapCommands, WhatAKilledRecorderLeftIsPlayedInPlaceOfItsFile) {
  ChildProcess child(
      {BAREHAND_PROGRAM, "record", "--source", "sim:fist,live=true,loop=true", "--out", folder_ / "a.mcap"});
  const std::string draft = folder_ / "a.mcap.unfinished";
  std::error_code not_yet;
  constexpr std::uintmax_t kSomeFrames = 500'000;  // bytes: the file's header alone cannot be played
  while (!fs::exists(draft) || fs::file_size(draft, not_yet) < kSomeFrames) std::this_thread::yield();
  const Outcome living = script(folder_.path(), "$B convert $D/a.mcap $D/living");
  EXPECT_EQ(living.exit_code, 2);
  EXPECT_THAT(living.output, HasSubstr("is still being written"));
  child.signal(SIGKILL);
  EXPECT_EQ(child.finish(), 128 + SIGKILL);
  const Outcome killed = script(folder_.path(), "$B convert $D/a.mcap $D/out");
  EXPECT_EQ(killed.exit_code, 0) << killed.output;
  EXPECT_THAT(killed.output, HasSubstr("was not finished"));
}

TEST_F(McapCommands, AFullDiskFailsAndSaysWhatIsKept) {
  make_recording();
  fs::create_symlink("/dev/full", folder_ / "full.mcap");
  const Outcome full = script(folder_.path(), "$B convert $D/take $D/full.mcap --overwrite");
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.output, HasSubstr("No space left on device"));
}

TEST_F(McapCommands, WhatCannotBeDoneIsSaid) {
  make_recording();
  expect_done("$B convert $D/take $D/a.mcap");
  const auto refused = [&](const std::string& arguments) {
    const Outcome outcome = script(folder_.path(), "$B " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    return outcome.output;
  };
  EXPECT_THAT(refused("convert $D/take $D/a.mcap"), HasSubstr("exists already"));
  EXPECT_THAT(refused("convert $D/a.mcap $D/a.mcap --overwrite"), HasSubstr("of the source"));
  EXPECT_THAT(refused("track --source log:$D/a.mcap --no-publish --mcap $D/a.mcap --overwrite"),
              HasSubstr("of the source"));
  EXPECT_THAT(refused("record --source folder:$D/take --out $D/b.mcap --max-size 1MB"),
              AllOf(HasSubstr("only an LCM log"), HasSubstr(".lcmlog")));
  EXPECT_THAT(refused("convert $D/a.mcap $D/b --channel /none"), HasSubstr("/camera/depth (sensor_msgs/msg/Image"));
}

TEST_F(McapCommands, StampsThatRosCannotHoldAreSaid) {
  make_recording();
  expect_done("sed -i 's/^[0-9]*\\./9&/; s/^9\\([0-9]*\\)\\./9000000000./' $D/take/depth.txt; rm $D/take/rgb.txt");
  const Outcome outcome = script(folder_.path(), "$B convert $D/take $D/a.mcap");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("beyond what ROS messages can hold"));
}

}  // namespace
}  // namespace barehand
