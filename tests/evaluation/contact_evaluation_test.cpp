#include "evaluation/contact_evaluation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/temp_folder.h"

namespace barehand {
namespace {

const Eigen::Vector3d kPlace(0, 0, 0.5);
constexpr int kIndexTip = segment_of(1, 2), kLittleTip = segment_of(4, 2);

/// One frame: the index fingertip is visible, the little one hidden; both are `distance` [m] from the object.
ContactSequence sequence(double distance) {
  ContactSequence out;
  TableFrame frame{0, 0.5, {}};
  for (TableRow& row : frame.rows) row.visible = 1;
  frame.rows[kLittleTip].visible = 0;
  out.poses.frames = {frame};
  out.truth[500'000].fill({1, {0, 0, 0.5}});
  out.truth[500'000][kIndexTip].distance = out.truth[500'000][kLittleTip].distance = distance;
  out.stated[500'000].fill({true, false, 0.05, kPlace});
  return out;
}

TEST(ContactEvaluation, CountsTouchesByWhatIsVisible) {
  // The visible touch is stated, the hidden one is unknown.
  ContactSequence both = sequence(0.001);
  both.stated[500'000][kIndexTip] = {true, true, 0.9, kPlace};
  both.stated[500'000][kLittleTip] = {};
  const auto e = evaluate_contacts({both});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->visible_tips.right, 1u);
  EXPECT_EQ(e->visible_tips.none, 3u);
  EXPECT_EQ(e->visible_tips.f1(), 1);
  EXPECT_EQ(e->hidden_tips.missed, 1u);
  EXPECT_EQ(e->hidden_tips.unknown, 1u);
  EXPECT_EQ(e->hidden_tips.f1(), 0);
  EXPECT_NEAR(e->segments.recall(), 0.5, 1e-9);
}

TEST(ContactEvaluation, AStatedTouchAtADistanceIsWrong) {
  ContactSequence apart = sequence(kTouchDistance + 0.001);
  apart.stated[500'000][kIndexTip] = {true, true, 0.9, kPlace};
  const auto e = evaluate_contacts({apart});
  EXPECT_EQ(e->visible_tips.wrong, 1u);
  EXPECT_EQ(e->visible_tips.precision(), 0);
}

TEST(ContactEvaluation, ATouchOfSomethingElseIsNoneOfTheObject) {
  ContactSequence table = sequence(0.1);
  table.stated[500'000][kIndexTip] = {true, true, 0.9, kPlace + Eigen::Vector3d(0, 0.1, 0)};
  const auto e = evaluate_contacts({table});
  EXPECT_EQ(e->visible_tips.wrong, 0u);
  EXPECT_EQ(e->visible_tips.none, 4u);
}

TEST(ContactEvaluation, BinsHoldStatedAgainstActual) {
  ContactSequence touching = sequence(0.001), apart = sequence(0.03);
  for (ContactSequence* one : {&touching, &apart}) one->stated[500'000][kIndexTip] = {true, true, 0.75, kPlace};
  const auto e = evaluate_contacts({touching, apart});
  ASSERT_EQ(e->probabilities.size(), 2u);
  EXPECT_NEAR(e->probabilities[0].stated, 0.05, 1e-9);
  EXPECT_NEAR(e->probabilities[1].stated, 0.75, 1e-9);
  EXPECT_NEAR(e->probabilities[1].actual, 0.5, 1e-9);
}

TEST(ContactEvaluation, WithoutACommonFrameThereIsNothingToSay) {
  ContactSequence other = sequence(0.001);
  other.poses.frames[0].timestamp += 1;
  EXPECT_FALSE(evaluate_contacts({other}));
}

TEST(ContactTable, IsReadAndWrongLinesAreNamed) {
  const test::TempFolder folder;
  const auto read = [&](const std::string& rows) {
    std::ofstream(folder / "contacts.csv") << "utime,segment,distance,x,y,z,nx,ny,nz\n" << rows;
    return read_contact_truth(folder / "contacts.csv");
  };
  const auto truth = read("500000,index_distal,-0.001,0,0,0.5,0,0,-1\n");
  ASSERT_TRUE(truth) << truth.error().message();
  EXPECT_EQ(truth->at(500'000)[kIndexTip].distance, -0.001);
  EXPECT_EQ(truth->at(500'000)[kIndexTip].point.z(), 0.5);
  EXPECT_GT(truth->at(500'000)[kLittleTip].distance, 1) << "no row, no touch";
  for (const char* bad : {"x,index_distal,0,0,0,0\n", "1,index_tip,0,0,0,0\n", "1,palm,nan,0,0,0\n", "1,palm\n",
                          "1,palm,1e9,0,0,0\n", "1,palm,0,0,0\n"}) {
    const auto refused = read(bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_NE(refused.error().message().find("line 2"), std::string::npos) << refused.error().message();
  }
  EXPECT_FALSE(read_contact_truth(folder / "none.csv"));
}

}  // namespace
}  // namespace barehand
