#include "evaluation/evaluation.h"

#include <gmock/gmock.h>

#include "hand/joint_angles.h"

namespace barehand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A hand with segments of 40 mm side by side; all but the last one are visible.
TableFrame truth_frame(std::int64_t number) {
  TableFrame frame{number, 0.1 * static_cast<double>(number), {}};
  for (int s = 0; s < kSegmentCount; ++s) frame.rows[s] = {{0.01 * s, 0, 0.5}, {0.01 * s, 0.04, 0.5}, 1};
  frame.rows[15].visible = 0.05;
  frame.rows[14].visible = 0.3;
  return frame;
}

ResultTable truth_of(int frames) {
  ResultTable table;
  for (int i = 0; i < frames; ++i) table.frames.push_back(truth_frame(i));
  return table;
}

TEST(Evaluation, ByHandComputedExample) {
  // Known displacements of single ends.
  ResultTable result = truth_of(1);
  result.frames[0].rows[3].proximal += Eigen::Vector3d(0.003, 0.004, 0);  // 5 mm
  result.frames[0].rows[3].distal += Eigen::Vector3d(0, 0, -0.001);       // 1 mm: error (5 + 1) / 2 = 3 mm
  result.frames[0].rows[15].proximal += Eigen::Vector3d(0, 0.010, 0);     // 10 mm at one end: 5 mm
  result.frames[0].rows[kPalm].distal += Eigen::Vector3d(0, 0, 0.016);    // 16 mm at one end: 8 mm

  // The errors follow from them.
  const auto e = evaluate(truth_of(1), result);
  ASSERT_TRUE(e) << e.error().message();
  EXPECT_NEAR(e->frames[0].segments[3], 0.003, 1e-12);
  EXPECT_NEAR(e->frame_error.mean, 0.016 / 16, 1e-12);
  EXPECT_NEAR(e->frame_error_without_palm.mean, 0.008 / 15, 1e-12);
  EXPECT_EQ(e->segment_error.count, 16u);
  EXPECT_NEAR(e->segment_error.max, 0.008, 1e-12);

  // So do those of seen and hidden segments.
  EXPECT_EQ(e->seen.count, 14u);
  EXPECT_NEAR(e->seen.mean, 0.011 / 14, 1e-12);
  EXPECT_EQ(e->hidden.count, 1u);
  EXPECT_NEAR(e->hidden.mean, 0.005, 1e-12);
  EXPECT_NEAR(e->per_segment[15].median, 0.005, 1e-12);
  EXPECT_TRUE(e->lost.empty());
}

TEST(Evaluation, OppositeErrorsOfBothEndsDoNotCancel) {
  ResultTable result = truth_of(1);
  result.frames[0].rows[5].proximal.y() += 0.004;
  result.frames[0].rows[5].distal.y() -= 0.004;
  EXPECT_NEAR(evaluate(truth_of(1), result)->frames[0].segments[5], 0.004, 1e-12);
}

TEST(Evaluation, FramesWithoutRowsAndFarOffFramesAreLost) {
  ResultTable result = truth_of(5);
  result.frames.erase(result.frames.begin() + 1);
  for (TableRow& row : result.frames[2].rows) row.proximal.z() += 0.0401, row.distal.z() += 0.0001;  // frame 3: 20.1 mm
  for (TableRow& row : result.frames[3].rows) row.proximal.z() += 0.0198, row.distal.z() += 0.0198;  // frame 4: 19.8 mm
  const auto e = evaluate(truth_of(5), result);
  ASSERT_TRUE(e);
  EXPECT_THAT(e->lost, ElementsAre(1, 3));
  EXPECT_EQ(e->untracked, 1u);
  EXPECT_EQ(e->frame_error.count, 4u) << "a far-off frame enters the mean";
  EXPECT_NEAR(e->frame_error.max, 0.0201, 1e-9);
}

TEST(Evaluation, ReturnsIntoViewAndHandsWhereThereIsNone) {
  ResultTable truth, result;
  for (int i : {0, 1, 2, 6, 7, 8, 9, 14, 15}) truth.frames.push_back(truth_frame(i));
  for (TableRow& row : truth.frames[3].rows) row.visible = 0.4;  // frame 6: hardly in view yet

  // 20: beyond the last frame of the truth
  for (int i : {0, 1, 2, 3, 9, 12, 20}) result.frames.push_back(truth_frame(i));
  const auto e = evaluate(truth, result);
  ASSERT_TRUE(e);
  EXPECT_THAT(e->false_hands, ElementsAre(3, 12));
  ASSERT_EQ(e->returns.size(), 2u);
  EXPECT_EQ(e->returns[0].number, 7);
  EXPECT_EQ(e->returns[0].frames, 2);
  EXPECT_EQ(e->returns[1].number, 14);
  EXPECT_EQ(e->returns[1].frames, std::nullopt);
}

TEST(Evaluation, ReturnsIntoViewWhenPlayedBackwards) {
  ResultTable truth, result;
  for (int i : {0, 1, 2, 6, 7, 8}) truth.frames.push_back(truth_frame(i));
  for (int i : {0, 1, 6, 7, 8}) result.frames.push_back(truth_frame(i));
  const auto e = evaluate(truth, result, {{}, -1});
  ASSERT_TRUE(e);
  ASSERT_EQ(e->returns.size(), 1u);
  EXPECT_EQ(e->returns[0].number, 2);
  EXPECT_EQ(e->returns[0].frames, 1);
}

TEST(Evaluation, NoHandAtAllIsLostThroughout) {
  const auto e = evaluate(truth_of(3), {});
  ASSERT_TRUE(e);
  EXPECT_THAT(e->lost, ElementsAre(0, 1, 2));
  EXPECT_EQ(e->frame_error.count, 0u);
  EXPECT_TRUE(std::isnan(e->frame_error.mean));
}

TEST(Evaluation, OnlyTheFramesPlayedAreExpected) {
  const auto expected = [](std::optional<std::int64_t> start, std::int64_t step) {
    return evaluate(truth_of(7), {}, {start, step})->lost;
  };
  EXPECT_THAT(expected({}, 3), ElementsAre(0, 3, 6));
  EXPECT_THAT(expected(2, 2), ElementsAre(2, 4, 6));
  EXPECT_THAT(expected(4, -2), ElementsAre(0, 2, 4));
  EXPECT_THAT(expected({}, -5), ElementsAre(1, 6));
  EXPECT_FALSE(evaluate(truth_of(3), {}, {9, 1}));
}

TEST(Evaluation, JointGapIsBetweenAdjacentEndsOfTheResult) {
  ResultTable result = truth_of(1);
  TableFrame& frame = result.frames[0];
  for (int s = 1; s < kSegmentCount; ++s)
    if (parent_of(s) != kPalm) frame.rows[s].proximal = frame.rows[parent_of(s)].distal;
  EXPECT_NEAR(evaluate(truth_of(1), result)->joint_gap.max, 0, 1e-15);
  frame.rows[5].proximal.x() += 0.002;  // the end of the index finger's proximal phalanx is off by 2 mm
  const Distribution gap = evaluate(truth_of(1), result)->joint_gap;
  EXPECT_EQ(gap.count, 10u);
  EXPECT_NEAR(gap.mean, 0.0002, 1e-12);
  EXPECT_NEAR(gap.max, 0.002, 1e-12);
}

TEST(Evaluation, TablesOfDifferentRecordingsAreRefused) {
  ResultTable other = truth_of(3);
  for (TableFrame& frame : other.frames) frame.number += 100;
  EXPECT_THAT(evaluate(truth_of(3), other).error().message(), HasSubstr("no frame in common"));
  other = truth_of(3);
  other.frames[1].timestamp += 0.01;
  EXPECT_THAT(evaluate(truth_of(3), other).error().message(), HasSubstr("frame 1 has other time stamps"));
}

TEST(Distribution, OfKnownNumbers) {
  const Distribution d = summarise({5, 1, 4, 2, 3});
  EXPECT_EQ(d.count, 5u);
  EXPECT_DOUBLE_EQ(d.mean, 3);
  EXPECT_DOUBLE_EQ(d.deviation, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(d.min, 1);
  EXPECT_DOUBLE_EQ(d.quartile1, 2);
  EXPECT_DOUBLE_EQ(d.median, 3);
  EXPECT_DOUBLE_EQ(d.quartile3, 4);
  EXPECT_DOUBLE_EQ(d.p90, 4.6);
  EXPECT_DOUBLE_EQ(d.max, 5);
  EXPECT_DOUBLE_EQ(summarise({1, 10}).median, 5.5);
  EXPECT_DOUBLE_EQ(summarise({7}).p95, 7);
}

}  // namespace
}  // namespace barehand
