#include "io/hand/decision_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "support/temp_folder.h"

namespace barehand {
namespace {

class DecisionsWritten : public testing::Test {
 protected:
  static HandEstimate estimate() {
    HandEstimate estimate;
    estimate.number = 7;
    estimate.utime = 1'280'000;
    estimate.handedness = Handedness::left;
    return estimate;
  }
  const test::TempFolder folder_;
  const std::string path_ = folder_ / "decisions.csv";
};

TEST_F(DecisionsWritten, OneARowInTheirOrder) {
  HandEstimate decided = estimate();
  decided.decisions.push_back({"search", "searched", "followed", 0.0012, 0.0031, 0.1});
  decided.decisions.push_back({"state", "tracking", "tentative", 0.0012, NAN, 0});
  auto table = DecisionTable::create(path_, false);
  ASSERT_TRUE(table) << table.error().message();
  ASSERT_TRUE(table->write(estimate())) << "nothing was decided";
  ASSERT_TRUE(table->write(decided));
  ASSERT_TRUE(table->finish());
  EXPECT_EQ(test::read_text(path_),
            "frame,timestamp,hand,rule,winner,winner_score,loser,loser_score,advantage\n"
            "7,1.280000,left,search,searched,0.001200,followed,0.003100,0.100000\n"
            "7,1.280000,left,state,tracking,0.001200,tentative,,0.000000\n");
}

TEST_F(DecisionsWritten, AreATableEvenIfNothingWasDecided) {
  auto table = DecisionTable::create(path_, false);
  ASSERT_TRUE(table);
  ASSERT_TRUE(table->finish());
  EXPECT_EQ(test::read_text(path_), "frame,timestamp,hand,rule,winner,winner_score,loser,loser_score,advantage\n");
  EXPECT_FALSE(DecisionTable::create(path_, false)) << "what exists is not replaced";
}

}  // namespace
}  // namespace barehand
