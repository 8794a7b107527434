#include "evaluation/grasp_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/temp_folder.h"

namespace barehand {
namespace {

constexpr int kWrap = 1, kRing = 4, kPinch = 12;

/// Frames every 0.1 s: 2 s without a grasp, 2 s with a wrap, all stated correctly with 0.8.
GraspSequence sequence() {
  GraspSequence out;
  for (int frame = 0; frame < 40; ++frame) {
    const int truth = frame < 20 ? 0 : kWrap;
    out.truth[100'000 * frame] = truth;
    out.stated[100'000 * frame] = {true, truth, 0.8, truth == 0 ? GraspKind::none : GraspKind::power};
  }
  return out;
}

TEST(GraspEvaluation, CountsWhatIsRight) {
  GraspSequence s = sequence();
  s.stated[3'000'000] = {true, kRing, 0.95, GraspKind::power};      // wrong and sure; the kind is right
  s.stated[3'100'000] = {true, kPinch, 0.4, GraspKind::precision};  // all wrong, not sure
  s.stated[3'200'000] = {};                                         // unknown
  s.stated.erase(3'300'000);                                        // not there: unknown
  const auto e = evaluate_grasps({s});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->held.frames, 20u);
  EXPECT_EQ(e->held.right, 16u);
  EXPECT_EQ(e->held.right_kind, 17u);
  EXPECT_EQ(e->held.confident_wrong, 1u);
  EXPECT_EQ(e->held.unknown, 2u);
  EXPECT_EQ(e->classes[kWrap].stated[kPinch], 1u);
  EXPECT_EQ(e->classes[0].frames, 14u) << "while the hand closes, nothing is compared";
  EXPECT_EQ(e->classes[0].right, 14u);
}

TEST(GraspEvaluation, CountsChangesWhileAGraspLasts) {
  GraspSequence s = sequence();
  EXPECT_EQ(evaluate_grasps({s})->changes, 0u) << "its begin is none";
  s.stated[3'000'000].grasp = kRing;
  s.stated[3'500'000] = {};
  const auto e = evaluate_grasps({s});
  EXPECT_EQ(e->changes, 2u);
  EXPECT_NEAR(e->held_seconds, 1.9, 1e-9);
  EXPECT_NEAR(e->changes_per_second(), 2 / 1.9, 1e-9);
}

TEST(GraspEvaluation, ComparesProbabilities) {
  GraspSequence s = sequence();
  s.stated[3'000'000].grasp = kRing;
  const auto e = evaluate_grasps({s});
  ASSERT_EQ(e->probabilities.size(), 1u);
  EXPECT_EQ(e->probabilities[0].count, 34u);
  EXPECT_NEAR(e->probabilities[0].stated, 0.8, 1e-9);
  EXPECT_NEAR(e->probabilities[0].actual, 33.0 / 34, 1e-9);
}

TEST(GraspEvaluation, TablesOfDifferentRecordingsAreRefused) {
  GraspSequence s = sequence();
  s.stated = {{77, {}}};
  const auto e = evaluate_grasps({sequence(), s});
  ASSERT_FALSE(e);
  EXPECT_THAT(e.error().message(), testing::HasSubstr("no frame in common"));
}

TEST(GraspTruths, AreReadOrRefusedWithTheLine) {
  const test::TempFolder folder;
  const std::string path = folder / "grasps.csv";
  const auto read = [&path](const char* text) {
    std::ofstream(path) << text;
    return read_grasp_truth(path);
  };
  const auto good = read("utime,grasp\n1000000,none\n1033333,pinch\n");
  ASSERT_TRUE(good) << good.error().message();
  EXPECT_THAT(*good, testing::ElementsAre(testing::Pair(1'000'000, 0), testing::Pair(1'033'333, kPinch)));
  EXPECT_THAT(read("utime,class\n").error().message(), testing::HasSubstr("header"));
  EXPECT_THAT(read("utime,grasp\n1,none\n2,hook\n").error().message(), testing::HasSubstr("line 3"));
  EXPECT_THAT(read("utime,grasp\nx,none\n").error().message(), testing::HasSubstr("line 2"));
  EXPECT_THAT(read("utime,grasp\n5\n").error().message(), testing::HasSubstr("line 2"));
  EXPECT_FALSE(read_grasp_truth("no/such/file.csv"));
}

}  // namespace
}  // namespace barehand
