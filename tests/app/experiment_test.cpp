#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "app/experiment/experiment_run.h"
#include "app/shared/run_inputs.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(ExperimentPlan, OcclusionCoversTheSevenLevelsWithEveryConfiguration) {
  const auto plan = plan_experiment("occlusion", {"paper", "default.yaml"});
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_EQ(plan->sequences.size(), 7u);
  EXPECT_EQ(plan->sequences.back(), "occlusion_6");
  ASSERT_EQ(plan->variants.size(), 2u);
  EXPECT_EQ(plan->variants[1].label, "default");
}

TEST(ExperimentPlan, RefusesWhatCannotBeCompared) {
  EXPECT_FALSE(plan_experiment("fist", {"nonsense"}));
  EXPECT_THAT(plan_experiment("fist", {"paper", "paper.yaml"}).error().message(), HasSubstr("called paper"));
  EXPECT_FALSE(plan_experiment("ablation", {"paper", "default"}));
}

TEST(ExperimentPlan, EveryAblationChangesTheDefault) {
  std::set<std::string> configs;
  const auto variants = ablations(read_configuration("default").value());
  for (const ExperimentVariant& variant : variants) configs.insert(print_config(variant.config));
  EXPECT_EQ(configs.size(), variants.size());
}

/// Results of two variants on one sequence; no segment was hidden.
ExperimentReport small_report() {
  ExperimentReport report{"fist", {}};
  for (const char* variant : {"paper", "default"}) {
    ExperimentRow row;
    row.sequence = "fist";
    row.run.label = variant;
    Evaluation& e = row.run.evaluation;
    e.frames.resize(3);
    e.lost = {2};
    e.frame_error = e.segment_error = e.seen = summarise({0.001, 0.002, 0.006});
    e.hidden = summarise({});
    row.track_ms = 7.25;
    report.rows.push_back(row);
  }
  return report;
}

TEST(ExperimentReport, TableGivesMillimetresAndADashWhereThereIsNothing) {
  EXPECT_THAT(experiment_table(small_report()),
              HasSubstr("fist    paper       3     1     3.00       2.00    5.20    6.00     3.00          -"));
}

TEST(ExperimentReport, IsWrittenForPeopleAndPrograms) {
  const test::TempFolder folder;
  ASSERT_TRUE(write_experiment(small_report(), folder.path()));
  EXPECT_EQ(test::read_text(folder / "fist.txt"), experiment_table(small_report()));
  EXPECT_THAT(test::read_text(folder / "fist.csv"), HasSubstr("\nfist,default,3,1,3.00,2.00,5.20,6.00,3.00,,0.0,7.2"));
  EXPECT_THAT(test::read_text(folder / "fist.json"), HasSubstr("\"hidden_mm\": null"));
  EXPECT_GT(fs::file_size(folder / "fist.png"), 1000u);
  EXPECT_FALSE(write_experiment(small_report(), folder / "missing"));
}

class ExperimentRun : public testing::Test {
 protected:
  ExperimentRun() {
    options_.out = folder_ / "out";
    options_.keys = {"width=160", "height=120", "scale=1.1"};
    options_.frames = 2;
  }
  test::TempFolder folder_;
  ExperimentPlan plan_ = plan_experiment("fist", {"default"}).value();
  ExperimentOptions options_;
};

TEST_F(ExperimentRun, RendersTracksAndCompares) {
  const auto report = run_experiment(plan_, options_);
  ASSERT_TRUE(report) << report.error().error.message();
  ASSERT_EQ(report->rows.size(), 1u);
  const Evaluation& evaluation = report->rows[0].run.evaluation;
  EXPECT_EQ(evaluation.frames.size(), 2u);
  EXPECT_LT(evaluation.frame_error.mean, 0.008) << "the hand's own profile and start went unused";
  EXPECT_GT(report->rows[0].track_ms, 0);
  for (const char* made : {"recordings/fist/hand.json", "results/fist.default.csv", "snapshots/fist.default/000001.jpg",
                           "plots/fist/time.png", "figures/fist.json", "fist.txt"})
    EXPECT_TRUE(fs::exists(folder_ / "out/" + made)) << made;
}

TEST_F(ExperimentRun, WrongOptionsLeaveNothingBehind) {
  options_.keys = {"colour=blue"};
  EXPECT_EQ(run_experiment(plan_, options_).error().exit_code, kExitUsage);
  options_.keys.clear();
  options_.hand = folder_ / "no_hand.json";
  EXPECT_EQ(run_experiment(plan_, options_).error().exit_code, kExitUsage);
  EXPECT_FALSE(fs::exists(options_.out));
}

TEST_F(ExperimentRun, OverwritesNothing) {
  fs::create_directories(options_.out + "/recordings");
  for (const bool overwrite : {false, true}) {
    options_.overwrite = overwrite;
    const auto report = run_experiment(plan_, options_);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().exit_code, kExitUsage);
    EXPECT_THAT(report.error().error.message(), HasSubstr("exists already")) << "and no experiment made it";
  }
}

TEST_F(ExperimentRun, AnExperimentIsReplacedIfAllowedAndOtherFilesStay) {
  options_.frames = 1;
  ASSERT_TRUE(run_experiment(plan_, options_));
  EXPECT_EQ(run_experiment(plan_, options_).error().exit_code, kExitUsage);
  test::write_text(folder_ / "out/notes.txt", "mine");
  test::write_text(folder_ / "out/results/fist.paper.csv", "of an earlier experiment");

  // Wrong input leaves what is there.
  options_.overwrite = true;
  ExperimentOptions wrong = options_;
  wrong.keys = {"colour=blue"};
  EXPECT_EQ(run_experiment(plan_, wrong).error().exit_code, kExitUsage);
  wrong = options_;
  wrong.hand = folder_ / "out/recordings/fist/hand.json";
  EXPECT_THAT(run_experiment(plan_, wrong).error().error.message(), HasSubstr("lies in the folder"));
  EXPECT_TRUE(fs::exists(folder_ / "out/fist.txt"));

  const auto report = run_experiment(plan_, options_);
  ASSERT_TRUE(report) << report.error().error.message();
  EXPECT_TRUE(fs::exists(folder_ / "out/fist.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "out/results/fist.paper.csv"));
  EXPECT_EQ(test::read_text(folder_ / "out/notes.txt"), "mine");
}

}  // namespace
}  // namespace barehand
