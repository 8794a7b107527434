#include "stages/refinement/refinement.h"

#include "math/angles.h"
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
  /// Puts a board in front of the first `rows` of the image.
  static void hide_above(int rows, HandObservation& observation) {
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < observation.depth.width(); ++u) {
        observation.label.at(u, v) = PixelLabel::object;
        observation.depth.at(u, v) = 0.3f;
      }
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
  hide_above(130, *observation);  // hides all fingers
  HandPose start = truth;
  for (SE3& T : start) T.t += Eigen::Vector3d(0.004, 0.003, -0.004);
  const RefinedPose refined = refinement_.refine(*observation, start, start, 10);
  EXPECT_LT(
      (distal_end(*profile_, refined.pose, segment_of(2, 2)) - distal_end(*profile_, truth, segment_of(2, 2))).norm(),
      0.006);
  EXPECT_LT(refined.visible[segment_of(2, 2)], 0.05);
}

TEST_F(RefinementTest, SkinThatIsAGuessAtTheKnucklesDoesNotTurnHiddenFingers) {
  // The data comes from a hand whose skin differs at the knuckles.
  const int root = segment_of(2, 0);
  Skin other_knuckles = *skin_;
  for (SkinVertex& v : other_knuckles.vertices) {
    if (v.weight_b == 0 || (v.a != kPalm && v.b != kPalm)) continue;
    // The difference grows with the weight of the finger.
    const bool on_palm = v.a == kPalm;
    const Eigen::Vector3f out = (on_palm ? v.weight_b : 1 - v.weight_b) * 0.006f * Eigen::Vector3f::UnitY();
    v.in_a -= out;
    v.in_b -= out;
  }

  // All fingers are hidden.
  const HandPose truth = test::facing_pose(*profile_, 0.45, 0.05);
  auto observation = test::observe_skin(other_knuckles, truth);

  // Cover the image down to the knuckles.
  hide_above(static_cast<int>(observation->frame->camera.project(truth[root].t).y()), *observation);

  // How far the refinement rotates the hidden finger in a second.
  const auto turned_after_a_second = [&](const Refinement& refinement) {
    HandPose pose = truth;
    for (int frame = 0; frame < 30; ++frame) pose = refinement.refine(*observation, pose, pose, 5).pose;
    const auto in_palm = [&](const HandPose& of) { return of[kPalm].inverse() * of[root]; };
    return boxminus(in_palm(pose), in_palm(truth)).tail<3>().norm() / kDegree;
  };

  // Guessed skin does not rotate it; scanned skin is trusted and does.
  EXPECT_LT(turned_after_a_second(refinement_), 1.5);
  auto scanned = std::make_shared<HandProfile>(*profile_);
  scanned->scanned_skin = skin_;
  EXPECT_GT(turned_after_a_second(Refinement(RefinementParams{}, scanned, skin_)), 4) << "a scan is believed";
}

}  // namespace
}  // namespace barehand
