#include "stages/refinement/refinement.h"

#include "math/random.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

class RefinementTest : public ::testing::Test {
 protected:
  double mean_end_error(const HandPose& a, const HandPose& b) const {
    double sum = 0;
    for (int s = 0; s < kSegmentCount; ++s)
      sum += (distal_end(*profile_, a, s) - distal_end(*profile_, b, s)).norm() / kSegmentCount;
    return sum;
  }
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  std::shared_ptr<const Skin> skin_ = std::make_shared<Skin>(make_blended_skin(*profile_, 0.004));
  Refinement refinement_{RefinementParams{}, profile_, skin_};
};

TEST_F(RefinementTest, FindsAPoseFromTenMillimetresAndDegreesAway) {
  const HandPose truth = test::facing_pose(*profile_, 0.45, 0.35);
  const auto observation = test::observe_skin(*skin_, truth);
  HandPose start = test::facing_pose(*profile_, 0.45, 0.2);
  for (SE3& T : start) T.t += Eigen::Vector3d(0.006, -0.005, 0.006);
  ASSERT_GT(mean_end_error(start, truth), 0.008);
  const RefinedPose refined = refinement_.refine(*observation, start, start, 12);
  EXPECT_LT(mean_end_error(refined.pose, truth), 0.001);
  EXPECT_LT(refined.score, 0.0005);
}

TEST_F(RefinementTest, TheStartThatExplainsMostIsRefined) {
  const HandPose truth = test::facing_pose(*profile_, 0.45, 0.35);
  const auto observation = test::observe_skin(*skin_, truth);
  const std::array<HandPose, 3> starts = {test::facing_pose(*profile_, 0.45, 0.0),
                                          test::facing_pose(*profile_, 0.45, 0.3),
                                          test::facing_pose(*profile_, 0.45, 0.15)};
  const RefinedPose best = refinement_.refine_best(*observation, starts, starts[0], 2);
  const RefinedPose second = refinement_.refine(*observation, starts[1], starts[0], 2);
  const RefinedPose first = refinement_.refine(*observation, starts[0], starts[0], 2);
  EXPECT_EQ(best.score, second.score);
  EXPECT_EQ(best.visible, second.visible);
  EXPECT_EQ(mean_end_error(best.pose, second.pose), 0);
  EXPECT_GT(mean_end_error(best.pose, first.pose), 0.001);
}

TEST_F(RefinementTest, JointsStayClosed) {
  const HandPose truth = test::facing_pose(*profile_, 0.45, 0.35);
  const auto observation = test::observe_skin(*skin_, truth);
  const HandPose start = test::facing_pose(*profile_, 0.45, 0.1);
  const RefinedPose refined = refinement_.refine(*observation, start, start, 12);
  for (int s = 1; s < kSegmentCount; ++s)
    EXPECT_LT((joint_in_parent(*profile_, refined.pose, s) - refined.pose[s].t).norm(), 0.0005) << s;
}

TEST_F(RefinementTest, HiddenFingerFollowsThePalm) {
  const HandPose truth = test::facing_pose(*profile_, 0.45, 0.2);
  auto observation = test::observe_skin(*skin_, truth);
  for (int v = 0; v < 130; ++v)  // a board before all fingers
    for (int u = 0; u < 320; ++u) {
      observation->label.at(u, v) = PixelLabel::object;
      observation->depth.at(u, v) = 0.3f;
    }
  HandPose start = truth;
  for (SE3& T : start) T.t += Eigen::Vector3d(0.004, 0.003, -0.004);
  const RefinedPose refined = refinement_.refine(*observation, start, start, 10);
  EXPECT_LT(
      (distal_end(*profile_, refined.pose, segment_of(2, 2)) - distal_end(*profile_, truth, segment_of(2, 2))).norm(),
      0.006);
  EXPECT_LT(refined.visible[segment_of(2, 2)], 0.05);
}

}  // namespace
}  // namespace barehand
