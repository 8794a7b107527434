#include "app/eval/eval_command.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "drivers/lcm/layouts.h"
#include "io/hand/hand_json.h"
#include "io/hand/result_table.h"
#include "io/lcm/lcm_log_writer.h"
#include "io/recording/recording_writer.h"
#include "support/temp_folder.h"
#include "tests/support/small_hand.h"

namespace barehand {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class EvalCommand : public testing::Test {
 protected:
  EvalCommand() {
    write_table("truth.csv", 0);
    write_table("out.csv", 0.002);
    EXPECT_TRUE(save_profile(test::small_hand(), folder_ / "hand.json"));
  }
  void write_table(const std::string& name, double offset) {
    auto writer = TableWriter::create(folder_ / name);
    for (int i = 0; i < 3; ++i) {
      TableFrame frame{i, 0.1 * i, {}};
      for (TableRow& row : frame.rows) row = {{offset, 0, 0.5}, {offset - 0.03, 0, 0.5}, 1};
      ASSERT_TRUE(writer->write(frame));
    }
  }
  /// A tetrahedron that lies in the camera for four frames.
  void write_block() {
    std::ofstream(folder_ / "block.obj") << "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\n"
                                            "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::ofstream truth(folder_ / "objects.csv");
    truth << "utime,object,held,x,y,z,qw,qx,qy,qz\n";
    for (int frame = 0; frame < 4; ++frame) truth << 1'000'000 + 100'000 * frame << ",block,0,0,0,0,1,0,0,0\n";
  }
  /// Runs the command line; `%` stands for the folder of the test.
  int run(std::string line) {
    for (auto at = line.find('%'); at != std::string::npos; at = line.find('%')) line.replace(at, 1, folder_.path());
    CLI::App app;
    int exit_code = -1;
    add_eval_command(app, exit_code);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    app.parse(line);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return exit_code;
  }
  test::TempFolder folder_;
  std::string out_, err_;
};

TEST_F(EvalCommand, PrintsMetricsAndWritesJsonAndPlots) {
  ASSERT_EQ(run("eval --truth %/truth.csv --result %/out.csv --hand %/hand.json --plots %/plots --json %/e.json"), 0)
      << err_;
  EXPECT_THAT(out_, HasSubstr("frames 3, tracked 3, lost 0"));
  const json report = json::parse(test::read_text(folder_ / "e.json"));
  EXPECT_NEAR(report["runs"][0]["frame_error_mm"]["mean"], 2, 1e-6);
  EXPECT_NEAR(report["runs"][0]["segments_mm"]["ring_distal"]["p95"], 2, 1e-6);
  EXPECT_NEAR(report["runs"][0]["mean_frame_error_over_hand_length"], 0.002 / test::small_hand().hand_length(), 1e-6);
  for (const char* plot : {"runs.png", "segments.png", "time.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "plots/" + plot)) << plot;
}

TEST_F(EvalCommand, NamesTheShippedHandAsTrackDoes) {
  ASSERT_EQ(run("eval --truth %/truth.csv --result %/out.csv --hand left --json %/e.json"), 0) << err_;
  const json report = json::parse(test::read_text(folder_ / "e.json"));
  const auto left = load_profile(BAREHAND_CONFIGS "/hands/adult_left.json");
  ASSERT_TRUE(left);
  EXPECT_NEAR(report["runs"][0]["mean_frame_error_over_hand_length"], 0.002 / left->hand_length(), 1e-6);
}

TEST_F(EvalCommand, ComparesSeveralRunsUnderTheirLabels) {
  ASSERT_EQ(run("eval --truth %/truth.csv --result %/out.csv %/truth.csv --label ours perfect --json %/e.json"), 0);
  const json report = json::parse(test::read_text(folder_ / "e.json"));
  EXPECT_EQ(report["runs"][1]["label"], "perfect");
  EXPECT_NEAR(report["runs"][1]["frame_error_mm"]["max"], 0, 1e-9);
}

TEST_F(EvalCommand, ComparesFingertipsWithLabels) {
  // A recording, from which the camera's intrinsics are read.
  auto writer = RecordingWriter::create(folder_ / "recording");
  RgbdFrame frame;
  frame.camera = {320, 240, 250, 250, 160, 120};
  frame.depth.reset(320, 240);
  ASSERT_TRUE(writer->write(frame) && writer->finish());
  // The true fingertip projects to u = 160 - 250 * 0.038 / 0.5 = 141.
  test::write_text(folder_ / "tips.csv", "frame,finger,u,v,visible\n1,index,141,123,1\n");

  // The distance to the label is reported and drawn.
  ASSERT_EQ(run("eval --result %/truth.csv --fingertips %/tips.csv --recording %/recording --hand %/hand.json "
                "--json %/e.json --plots %/plots"),
            0)
      << err_;
  const json report = json::parse(test::read_text(folder_ / "e.json"));
  EXPECT_NEAR(report["fingertips"]["fingers_px"]["index"]["median"], 3, 1e-6);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "plots/fingertips.png"));
}

TEST_F(EvalCommand, JudgesTheUncertaintyOfStatesInALog) {
  // States with a known error and a stated uncertainty.
  auto log = LcmLogWriter::create(folder_ / "states.lcmlog", false);
  ASSERT_TRUE(log);
  for (int i = 0; i < 3; ++i) {
    hand_state_t state{};
    state.frame_number = i;
    state.utime = 100'000 * i;
    state.has_pose = i < 2;
    for (segment_state_t& s : state.segments) {  // 2 mm off along x, like the poses of out.csv
      s.position[0] = 0.002, s.position[2] = s.distal[2] = 0.5, s.distal[0] = 0.002 - 0.03;
      for (int k = 0; k < 3; ++k) s.covariance[k][k] = 1e-6;
      s.covariance[4][4] = 0.01;  // a rotation about y moves the distal end, 30 mm along -x, in depth
      s.confidence = 0.95;
    }
    ASSERT_TRUE((*log)->send("HAND_STATE", encode_message(state), i));
    ASSERT_TRUE((*log)->send("OTHER", std::vector<std::uint8_t>(24), i));
  }

  // Coverage, errors and confidence follow from them.
  log->reset();
  ASSERT_EQ(run("eval --truth %/truth.csv --states %/states.lcmlog --json %/e.json --plots %/plots"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("stated uncertainty, 2 frames"));
  const json judged = json::parse(test::read_text(folder_ / "e.json"))["reliability"];
  EXPECT_NEAR(judged["intervals_90"]["all"]["covered"], 2.0 / 3, 1e-6) << "2 mm is more than 1.645 of 1 mm, along x";
  EXPECT_NEAR(judged["intervals_90"]["all"]["actual_mm"], 2, 1e-6);
  EXPECT_NEAR(judged["errors_mm"][0]["stated"], std::sqrt(3), 1e-5) << "proximal ends";
  EXPECT_NEAR(judged["errors_mm"][1]["stated"], std::sqrt(3 + 9), 1e-5) << "distal ends: 0.1 rad of 30 mm on top";
  EXPECT_NEAR(judged["within_10_mm"][0]["actual"], 1, 1e-9);
  for (const char* plot : {"reliability.png", "confidence.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "plots/" + plot)) << plot;
}

TEST_F(EvalCommand, RefusesStatesWhoseUncertaintyIsNoNumber) {
  auto log = LcmLogWriter::create(folder_ / "states.lcmlog", false);
  ASSERT_TRUE(log);
  hand_state_t state{};
  state.has_pose = true;
  state.segments[3].covariance[1][1] = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE((*log)->send("HAND_STATE", encode_message(state), 0));
  log->reset();
  EXPECT_EQ(run("eval --truth %/truth.csv --states %/states.lcmlog"), 2);
  EXPECT_THAT(err_, HasSubstr("frame 0 has a pose with invalid numbers"));
}

TEST_F(EvalCommand, RefusesTheStatesOfTwoHandsAndOfTwoRuns) {
  for (const auto& [frame, side, complaint] : {std::tuple(1, hand_state_t::LEFT, "holds the states of two hands"),
                                               {0, hand_state_t::RIGHT, "frame 0 occurs twice"}}) {
    auto log = LcmLogWriter::create(folder_ / "states.lcmlog", true);
    ASSERT_TRUE(log);

    // Two states for one frame: of two hands, or of two runs.
    hand_state_t state{};
    state.has_pose = true;
    state.handedness = hand_state_t::RIGHT;
    ASSERT_TRUE((*log)->send("HAND_STATE", encode_message(state), 0));
    state.frame_number = frame;
    state.handedness = side;
    ASSERT_TRUE((*log)->send("HAND_STATE", encode_message(state), 1));

    // The command refuses them.
    log->reset();
    EXPECT_EQ(run("eval --truth %/truth.csv --states %/states.lcmlog"), 2);
    EXPECT_THAT(err_, HasSubstr(complaint));
  }
}

TEST_F(EvalCommand, WhatIsReadIsNeverReplaced) {
  std::filesystem::create_hard_link(folder_ / "out.csv", folder_ / "link.json");
  std::filesystem::create_directories(folder_ / "plots");
  std::filesystem::create_symlink("../truth.csv", folder_ / "plots/time.png");
  const std::string truth = test::read_text(folder_ / "truth.csv"), result = test::read_text(folder_ / "out.csv");
  for (const char* output : {"--json %/truth.csv", "--json %/hand.json", "--json %/link.json", "--plots %/plots"}) {
    EXPECT_EQ(run(std::string("eval --truth %/truth.csv --result %/out.csv --hand %/hand.json --overwrite ") + output),
              2);
    EXPECT_THAT(err_, HasSubstr("never replaced")) << output;
  }
  EXPECT_EQ(test::read_text(folder_ / "truth.csv"), truth);
  EXPECT_EQ(test::read_text(folder_ / "out.csv"), result);
}

TEST_F(EvalCommand, FiguresAndPlotsAreReplacedOnlyIfAllowed) {
  const std::string line = "eval --truth %/truth.csv --result %/out.csv --json %/e.json --plots %/plots";
  ASSERT_EQ(run(line), 0);
  EXPECT_EQ(run(line), 2);
  EXPECT_THAT(err_, HasSubstr("--overwrite"));
  std::filesystem::remove(folder_ / "e.json");
  EXPECT_EQ(run(line), 2) << "plots are there";
  EXPECT_EQ(run(line + " --overwrite"), 0);
}

TEST_F(EvalCommand, ATableWithoutFramesIsAResultButNoTruth) {
  ASSERT_TRUE(TableWriter::create(folder_ / "none.csv")->finish());
  EXPECT_EQ(run("eval --truth %/truth.csv --result %/none.csv"), 0);
  EXPECT_THAT(err_, HasSubstr("none.csv: no hand was tracked in any of the 3 frames"));
  EXPECT_EQ(run("eval --truth %/none.csv --result %/out.csv"), 2);
  EXPECT_EQ(run("eval --truth %/none.csv --result %/none.csv"), 2);
  test::write_text(folder_ / "empty.csv", "");
  EXPECT_EQ(run("eval --truth %/truth.csv --result %/empty.csv"), 2);
}

TEST_F(EvalCommand, BadCallsSayWhatIsMissing) {
  // Missing or wrong inputs.
  EXPECT_EQ(run("eval --truth %/truth.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("--result or --states"));
  EXPECT_EQ(run("eval --truth %/truth.csv --states a.lcmlog b.lcmlog"), 2);
  EXPECT_THAT(err_, HasSubstr("a log of hand states for each"));
  EXPECT_EQ(run("eval --truth %/truth.csv --states %/truth.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("truth.csv"));

  // Options that need others.
  EXPECT_EQ(run("eval --result %/out.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("give --truth"));
  EXPECT_EQ(run("eval --result %/out.csv --fingertips tips.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("--recording"));

  // Files that cannot be read or written.
  EXPECT_EQ(run("eval --result %/none.csv --truth %/truth.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("none.csv: cannot be read"));
  EXPECT_EQ(run("eval --result %/out.csv --truth %/truth.csv --json /no/such/place.json"), 1);
  EXPECT_THAT(err_, HasSubstr("/no/such/place.json: cannot be written"));
  EXPECT_THAT(out_, HasSubstr("frames 3")) << "what was computed is printed all the same";

  // Numbers that are none of a frame.
  EXPECT_EQ(run("eval --result %/out.csv --truth %/truth.csv --start -9223372036854775808 --step -1"), 2);
  EXPECT_THAT(err_, HasSubstr("--start"));

  // Labels that do not fit.
  EXPECT_EQ(run("eval --result %/out.csv %/out.csv --truth %/truth.csv --label one"), 2);
  EXPECT_THAT(err_, HasSubstr("--label"));
}

TEST_F(EvalCommand, PathsNeedNotBeUtf8) {
  const std::string old = folder_ / "mess\xfcng.csv";
  std::filesystem::copy(folder_ / "out.csv", old);
  EXPECT_EQ(run("eval --truth %/truth.csv --result " + old + " --json %/e.json"), 0) << err_;
  const json report = json::parse(test::read_text(folder_ / "e.json"));
  EXPECT_THAT(report["runs"][0]["result"].get<std::string>(), HasSubstr("mess\xef\xbf\xbdng.csv"));
}

TEST_F(EvalCommand, ComparesGraspsAlsoWithoutTheTruthOfPoses) {
  // Four frames with a pinch, one of which is taken for a ring.
  auto log = LcmLogWriter::create(folder_ / "states.lcmlog", false);
  ASSERT_TRUE(log);
  std::string table = "utime,grasp\n";
  for (int frame = 0; frame < 4; ++frame) {
    grasp_state_t state{};
    state.utime = 1'000'000 + 100'000 * frame;
    state.handedness = hand_state_t::RIGHT;
    state.grasp = frame == 2 ? grasp_state_t::RING : grasp_state_t::PINCH;
    state.kind = frame == 2 ? grasp_state_t::POWER : grasp_state_t::PRECISION;
    state.probability = 0.95;
    ASSERT_TRUE((*log)->send("GRASP_STATE", encode_message(state), state.utime));
    table += std::to_string(state.utime) + ",pinch\n";
  }
  ASSERT_TRUE((*log)->finish());
  std::ofstream(folder_ / "grasps.csv") << table;

  ASSERT_EQ(run("eval --states %/states.lcmlog --grasps %/grasps.csv --json %/e.json"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("ring 25.0"));
  const json report = json::parse(test::read_text(folder_ / "e.json"))["grasps"];
  EXPECT_EQ(report["held"]["frames"], 4);
  EXPECT_EQ(report["held"]["right"], 0.75);
  EXPECT_EQ(report["held"]["right_kind"], 0.75);
  EXPECT_EQ(report["held"]["confident_wrong"], 0.25);
  EXPECT_NEAR(report["changes_per_second"], 2 / 0.3, 1e-6);

  EXPECT_EQ(run("eval --states %/states.lcmlog --grasps a.csv b.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("--grasps is given 2 times"));
  EXPECT_EQ(run("eval --states %/states.lcmlog --grasps %/truth.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("header"));
}

TEST_F(EvalCommand, ComparesOnlyPosesOfObjectsThatArePoses) {
  // Four frames with an object 1 mm beside its place; in the last three, the message holds no pose.
  auto log = LcmLogWriter::create(folder_ / "states.lcmlog", false);
  ASSERT_TRUE(log);
  std::string grasps = "utime,grasp\n";
  for (int frame = 0; frame < 4; ++frame) {
    object_state_t state{};
    state.utime = 1'000'000 + 100'000 * frame;
    state.object_id = 1;
    state.position[0] = frame == 1 ? NAN : 0.001;
    state.orientation[0] = frame == 2 ? NAN : frame == 3 ? 0 : 1;
    ASSERT_TRUE((*log)->send("OBJECT_STATE", encode_message(state), state.utime));
    grasp_state_t grasp{};
    grasp.utime = state.utime;
    ASSERT_TRUE((*log)->send("GRASP_STATE", encode_message(grasp), grasp.utime));
    grasps += std::to_string(state.utime) + ",none\n";
  }
  ASSERT_TRUE((*log)->finish());
  std::ofstream(folder_ / "grasps.csv") << grasps;
  write_block();

  ASSERT_EQ(run("eval --states %/states.lcmlog --grasps %/grasps.csv --objects %/objects.csv --json %/e.json"), 0)
      << err_;
  const json report = json::parse(test::read_text(folder_ / "e.json"))["objects"][0];
  EXPECT_EQ(report["frames"], 4);
  EXPECT_EQ(report["stated"], 1);
  EXPECT_EQ(report["lost"], 3);

  // Beside a log, the simulator begins the names of both files with that of the log.
  std::filesystem::rename(folder_ / "objects.csv", folder_ / "take.objects.csv");
  EXPECT_EQ(run("eval --states %/states.lcmlog --grasps %/grasps.csv --objects %/take.objects.csv"), 2);
  EXPECT_THAT(err_, HasSubstr("take.block.obj: there is no such file"));
  std::filesystem::rename(folder_ / "block.obj", folder_ / "take.block.obj");
  EXPECT_EQ(run("eval --states %/states.lcmlog --grasps %/grasps.csv --objects %/take.objects.csv"), 0) << err_;

  // Nor is the mesh replaced, though no option names it.
  EXPECT_EQ(run("eval --states %/states.lcmlog --grasps %/grasps.csv --objects %/take.objects.csv --overwrite "
                "--json %/take.block.obj"),
            2);
  EXPECT_THAT(err_, HasSubstr("never replaced"));
}

TEST_F(EvalCommand, EvaluatesTheRestWhereAnObjectWasNeverFound) {
  auto log = LcmLogWriter::create(folder_ / "states.lcmlog", false);
  ASSERT_TRUE(log);
  grasp_state_t grasp{};
  grasp.utime = 1'000'000;
  ASSERT_TRUE((*log)->send("GRASP_STATE", encode_message(grasp), grasp.utime));
  ASSERT_TRUE((*log)->finish());
  std::ofstream(folder_ / "grasps.csv") << "utime,grasp\n1000000,none\n";
  write_block();

  ASSERT_EQ(run("eval --states %/states.lcmlog --grasps %/grasps.csv --objects %/objects.csv --json %/e.json"), 0)
      << err_;
  EXPECT_THAT(err_, HasSubstr("block is stated in none of the 4 frames"));
  const json report = json::parse(test::read_text(folder_ / "e.json"));
  EXPECT_EQ(report["objects"][0]["stated"], 0);
  EXPECT_EQ(report["objects"][0]["position_mm"]["count"], 0);
  EXPECT_TRUE(report.contains("grasps"));
}

}  // namespace
}  // namespace barehand
