// Outputs that are the standard output, another descriptor, or a named pipe.
#include <gmock/gmock.h>

#include "io/hand/hand_json.h"
#include "io/hand/result_table.h"
#include "io/lcm/lcm_log_reader.h"
#include "support/barehand_program.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

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

TEST_F(PipedOutputs, WhatCannotBeIsRefused) {
  const Outcome two = run("$B track --source sim:two_hands --hand both --no-publish --result /dev/stdout");
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.output, HasSubstr("two hands are tracked"));
  const Outcome mixed = run(kTrack + "--result /dev/stdout --states-log /dev/fd/1");
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.output, HasSubstr("is what --result /dev/stdout writes, too"));
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
