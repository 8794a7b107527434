// Tests outputs to the standard output, to another descriptor and to a named pipe.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "io/hand/hand_json.h"
#include "io/hand/result_table.h"
#include "io/lcm/lcm_log_reader.h"
#include "support/barehand_program.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class PipedOutputs : public ::testing::Test {
 protected:
  PipedOutputs() {
    test::write_text(folder_ / "quick.yaml", test::quick_config());
    EXPECT_EQ(run("$B sim fist,width=160,height=120,frames=4 --out $D/take").exit_code, 0);
    EXPECT_EQ(run(kTrack + "--result $D/whole.csv --states-log $D/whole.lcmlog --save-hand $D/whole.json").exit_code,
              0);
    table_ = test::read_text(folder_ / "whole.csv");
  }
  Outcome run(const std::string& text) const { return script(folder_.path(), text); }
  std::string text_of(const char* name) const { return test::read_text(folder_ / name); }

  const std::string kTrack =
      "$B track --source folder:$D/take --init $D/take/start_pose.json --hand $D/take/hand.json --no-publish --config "
      "$D/quick.yaml ";
  const test::TempFolder folder_;
  std::string table_;
};

TEST_F(PipedOutputs, ATableOnTheStandardOutputIsClean) {
  ASSERT_GT(read_table(folder_ / "whole.csv")->frames.size(), 2u);
  for (const std::string name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "$D/link"}) {
    const Outcome file = run("ln -sf /dev/stdout $D/link; " + kTrack + "--result " + name + " 2>&1 >$D/out.csv");
    EXPECT_EQ(file.exit_code, 0) << file.output;
    EXPECT_EQ(text_of("out.csv"), table_) << name;
    EXPECT_THAT(file.output, HasSubstr("4 published")) << "the summary is on standard error";
  }
  EXPECT_EQ(run(kTrack + "--result /dev/stdout 2>$D/err | cat >$D/out.csv").exit_code, 0);
  EXPECT_EQ(text_of("out.csv"), table_);
}

TEST_F(PipedOutputs, WhatADescriptorHoldsAlreadyStays) {
  EXPECT_EQ(run("(echo before; " + kTrack + "--result /dev/stdout; echo after) >$D/out.csv").exit_code, 0);
  EXPECT_EQ(text_of("out.csv"), "before\n" + table_ + "after\n");
  EXPECT_EQ(run("echo before >$D/out.csv; " + kTrack + "--result /dev/stdout >>$D/out.csv").exit_code, 0);
  EXPECT_EQ(text_of("out.csv"), "before\n" + table_);
  const Outcome other = run("(echo before >&5; " + kTrack + "--result /dev/fd/5; echo after >&5) 5>$D/out.csv");
  EXPECT_THAT(other.output, HasSubstr("4 published"));
  EXPECT_EQ(text_of("out.csv"), "before\n" + table_ + "after\n");
}

TEST_F(PipedOutputs, LogsAndProfilesGoThereToo) {
  EXPECT_EQ(run(kTrack + "--states-log /dev/stdout >$D/out.lcmlog").exit_code, 0);
  EXPECT_EQ(text_of("out.lcmlog"), text_of("whole.lcmlog"));
  EXPECT_EQ(run(kTrack + "--save-hand /dev/stdout >$D/out.json").exit_code, 0);
  EXPECT_EQ(text_of("out.json"), text_of("whole.json"));
  EXPECT_EQ(run("ln -s /dev/stdout $D/link.lcmlog; $B convert $D/take $D/take.lcmlog; "
                "$B convert $D/take $D/link.lcmlog >$D/out.lcmlog")
                .exit_code,
            0);
  EXPECT_EQ(text_of("out.lcmlog"), text_of("take.lcmlog"));
}

TEST_F(PipedOutputs, FiguresOfEvalAndBenchAreClean) {
  const std::string eval = "$B eval --result $D/whole.csv --truth $D/take/truth.csv ";
  const Outcome file = run(eval + "--json $D/whole.figures");
  const Outcome piped = run(eval + "--json /dev/stdout 2>&1 >$D/out.figures");
  EXPECT_EQ(text_of("out.figures"), text_of("whole.figures"));
  EXPECT_EQ(piped.output, file.output);
  const Outcome bench =
      run("$B bench --source folder:$D/take --config $D/quick.yaml --frames 2 --warm-up 0 --store 2 "
          "--json /dev/stdout 2>/dev/null");
  EXPECT_EQ(bench.exit_code, 0);
  EXPECT_THAT(bench.output, StartsWith("{"));
  EXPECT_TRUE(bench.output.ends_with("}\n")) << bench.output;
}

TEST_F(PipedOutputs, AScannedHandIsWrittenOnce) {
  const Outcome scan =
      run("$B calibrate --source folder:$D/take --config $D/quick.yaml --hand right --out /dev/stdout "
          "2>$D/err >$D/out.json");
  EXPECT_EQ(scan.exit_code, 0) << text_of("err");
  EXPECT_TRUE(load_profile(folder_ / "out.json")) << text_of("out.json");
  EXPECT_THAT(text_of("err"), HasSubstr("frames tracked"));
}

/// The result of a single read from a named pipe.
std::string some_of(const std::string& pipe, int file) {
  std::string text(1 << 16, ' ');
  const ssize_t count = read(file, text.data(), text.size());
  EXPECT_GT(count, 0) << pipe;
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

TEST_F(PipedOutputs, AReaderThatGoesAndComesBackCostsNothingElse) {
  const std::string pipe = folder_ / "pipe.csv";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ChildProcess track({BAREHAND_PROGRAM, "track", "--source", "sim:fist,width=160,height=120,live=true,loop=true,fps=20",
                      "--hand", folder_ / "take/hand.json", "--init", folder_ / "take/start_pose.json", "--no-publish",
                      "--config", folder_ / "quick.yaml", "--result", pipe, "--states-log", folder_ / "live.lcmlog"});
  ASSERT_TRUE(track.wait_for("waiting for a program to read the pipe " + pipe)) << track.output();
  int reader = open(pipe.c_str(), O_RDONLY);
  EXPECT_THAT(some_of(pipe, reader), StartsWith("frame,timestamp"));
  close(reader);

  ASSERT_TRUE(track.wait_for("no program reads this pipe")) << track.output();
  reader = open(pipe.c_str(), O_RDONLY);
  std::string again;
  while (again.find("\nframe,timestamp") == std::string::npos && !again.starts_with("frame,timestamp"))
    again += some_of(pipe, reader);
  again = some_of(pipe, reader);
  EXPECT_THAT(again, HasSubstr(",palm,"));

  track.signal(SIGTERM);
  EXPECT_EQ(track.finish(), 0) << track.output();
  close(reader);
  const auto log = LcmLogReader::open(folder_ / "live.lcmlog");
  ASSERT_TRUE(log) << log.error().message();
  EXPECT_EQ(log->damaged_bytes(), 0);
  std::size_t states = 0;
  for (const LogEntry& entry : log->entries()) states += entry.channel == "HAND_STATE";
  EXPECT_THAT(track.output(), ContainsRegex("states log +" + std::to_string(states) + " "));
}

/// A live run goes on with everything else while the reader of a pipe does nothing.
TEST_F(PipedOutputs, AReaderThatDoesNotReadDelaysNothingElse) {
  const std::string pipe = folder_ / "pipe.csv";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  test::write_text(folder_ / "no_scans.yaml", test::replaced(test::quick_config(), "scans: 3", "scans: 0"));
  ChildProcess track({BAREHAND_PROGRAM, "track", "--source", "sim:fist,width=160,height=120,live=true,loop=true,fps=60",
                      "--hand", folder_ / "take/hand.json", "--init", folder_ / "take/start_pose.json", "--no-publish",
                      "--config", folder_ / "no_scans.yaml", "--result", pipe, "--states-log",
                      folder_ / "live.lcmlog"});
  ASSERT_TRUE(track.wait_for("waiting for a program to read the pipe " + pipe)) << track.output();
  const int reader = open(pipe.c_str(), O_RDONLY);
  std::string table = some_of(pipe, reader);
  constexpr int kSmall = 1 << 16;  // bytes; so that the pipe is full soon
  ASSERT_EQ(fcntl(reader, F_SETPIPE_SZ, kSmall), kSmall);
  ASSERT_TRUE(track.wait_for("the reader of this pipe is behind")) << track.output();

  // When it reads again, rows come again, and the end of the run is not waited for.
  while (table.size() < 2 * kSmall) table += some_of(pipe, reader);
  track.signal(SIGTERM);
  EXPECT_EQ(track.finish(), 0) << track.output();
  char piece[4096];
  for (ssize_t size = 0; (size = read(reader, piece, sizeof piece)) > 0;)
    table.append(piece, static_cast<std::size_t>(size));
  close(reader);

  // There are whole rows only.
  EXPECT_TRUE(table.ends_with('\n'));
  std::istringstream rows(table);
  std::string row;
  std::getline(rows, row);
  const auto columns = std::ranges::count(row, ',');
  while (std::getline(rows, row)) ASSERT_EQ(std::ranges::count(row, ','), columns) << row;

  // The other output has everything.
  const auto log = LcmLogReader::open(folder_ / "live.lcmlog");
  ASSERT_TRUE(log) << log.error().message();
  const auto states = std::ranges::count(log->entries(), std::string("HAND_STATE"), &LogEntry::channel);
  EXPECT_THAT(track.output(), ContainsRegex("states log +" + std::to_string(states) + " "));
}

TEST_F(PipedOutputs, ARecordingWaitsForAReaderAndCanBeStopped) {
  const std::string take = "folder:" + (folder_ / "take");
  for (const std::string name : {"pipe.lcmlog", "pipe.mcap"}) {
    ASSERT_EQ(mkfifo((folder_ / name).c_str(), 0600), 0);
    ChildProcess stopped({BAREHAND_PROGRAM, "record", "--source", take, "--out", folder_ / name});
    ASSERT_TRUE(stopped.wait_for("waiting for a program to read the pipe")) << stopped.output();
    stopped.signal(SIGINT);
    EXPECT_EQ(stopped.finish(), 130) << stopped.output();

    const Outcome read = run("cat $D/" + name + " >$D/read-" + name + " & $B convert $D/take $D/" + name +
                             "; rc=$?; wait; $B convert $D/take $D/whole-" + name + "; exit $rc");
    EXPECT_EQ(read.exit_code, 0) << read.output;
    EXPECT_EQ(text_of(("read-" + name).c_str()), text_of(("whole-" + name).c_str()));
  }
  const Outcome folder = run("$B convert $D/take /dev/stdout");
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_THAT(folder.output, HasSubstr("/dev/stdout: is no folder (a file, also a pipe"));
}

TEST_F(PipedOutputs, ARunThatWaitsForAReaderCanBeStopped) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const std::string option : {"--result", "--states-log", "--log-decisions", "--save-hand"}) {
    ChildProcess track({BAREHAND_PROGRAM, "track", "--source", "folder:" + (folder_ / "take"), "--no-publish", option,
                        folder_ / "pipe"});
    ASSERT_TRUE(track.wait_for("waiting for a program to read the pipe")) << track.output();
    track.signal(SIGINT);
    EXPECT_EQ(track.finish(), 130) << track.output();
  }
}

TEST_F(PipedOutputs, AVideoCanGoIntoAPipe) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.mkv").c_str(), 0600), 0);
  ChildProcess stopped({BAREHAND_PROGRAM, "track", "--source", "folder:" + (folder_ / "take"), "--no-publish",
                        "--overlay", folder_ / "pipe.mkv"});
  ASSERT_TRUE(stopped.wait_for("waiting for a program to read the pipe")) << stopped.output();
  stopped.signal(SIGTERM);
  EXPECT_EQ(stopped.finish(), 130) << stopped.output();

  const Outcome read = run("cat $D/pipe.mkv >$D/out.mkv & " + kTrack + "--overlay $D/pipe.mkv; rc=$?; wait; exit $rc");
  EXPECT_EQ(read.exit_code, 0) << read.output;
  EXPECT_THAT(text_of("out.mkv"), StartsWith("\x1a\x45\xdf\xa3")) << "the signature of Matroska";
  EXPECT_GT(text_of("out.mkv").size(), 1000u);

  // A live run would wait for a reader that is slow, and images need a folder.
  const Outcome live = run("$B track --source sim:fist,live=true --no-publish --overlay $D/pipe.mkv");
  EXPECT_EQ(live.exit_code, 2);
  EXPECT_THAT(live.output, HasSubstr("is a pipe, whose reader could hold up"));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const Outcome images = run(kTrack + "--overlay $D/pipe");
  EXPECT_EQ(images.exit_code, 2);
  EXPECT_THAT(images.output, HasSubstr("images need a folder"));
}

TEST_F(PipedOutputs, AStandardOutputThatNobodyReadsIsNotWaitedFor) {
  const Outcome gone = run("exec 3> >(true); wait $!; " + kTrack + "--result /dev/stdout >&3");
  EXPECT_EQ(gone.exit_code, 1);
  EXPECT_THAT(gone.output, HasSubstr("Broken pipe"));
}

TEST_F(PipedOutputs, AReaderThatDoesNotWaitForTheHandIsNotWaitedFor) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const Outcome gone = run("(exec 3<$D/pipe) & " + kTrack + "--save-hand $D/pipe --result $D/out.csv");
  EXPECT_EQ(gone.exit_code, 1) << gone.output;
  EXPECT_EQ(text_of("out.csv"), table_);
  const Outcome stays = run("cat $D/pipe >$D/out.json & " + kTrack + "--save-hand $D/pipe; rc=$?; wait; exit $rc");
  EXPECT_EQ(stays.exit_code, 0) << stays.output;
  EXPECT_EQ(text_of("out.json"), text_of("whole.json"));
}

TEST_F(PipedOutputs, WhatCannotBeIsRefused) {
  const Outcome two = run("$B track --source sim:two_hands --hand both --no-publish --result /dev/stdout");
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.output, HasSubstr("two hands are tracked"));
  const Outcome mixed = run(kTrack + "--result /dev/stdout --states-log /dev/fd/1");
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.output, HasSubstr("is also written by --result /dev/stdout"));
  const Outcome input = run(kTrack + "--result /dev/fd/5 5<>$D/take/truth.csv");
  EXPECT_EQ(input.exit_code, 2);
  EXPECT_THAT(input.output, HasSubstr("truth.csv of the source"));
  const Outcome reading = run(kTrack + "--result /dev/fd/5 5<$D/whole.json");
  EXPECT_NE(reading.exit_code, 0);
  EXPECT_THAT(reading.output, HasSubstr("is open for reading only"));
  const Outcome closed = run(kTrack + "--result /dev/fd/77");
  EXPECT_NE(closed.exit_code, 0);
  EXPECT_THAT(closed.output, HasSubstr("Bad file descriptor"));
}

}  // namespace
}  // namespace barehand
