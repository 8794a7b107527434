#include "tracking/hypotheses/neutral_pose.h"

#include <gtest/gtest.h>

#include "hand/skin.h"
#include "math/angles.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

/// A hand of which only the palm and the segments jointed to it are visible. An object hides the rest.
class RelaxedPose : public testing::Test {
 protected:
  static bool shown(int s) { return s == kPalm || parent_of(s) == kPalm; }

  void SetUp() override {
    // Observe the whole hand.
    auto hand = test::observe_skin(*skin_, pose_);
    RenderedHand rendered;
    const Intrinsics& camera = hand->frame->camera;
    render_hand(*skin_, pose_, camera, {0, 0, 1, camera.width, camera.height}, rendered);
    Image<std::int32_t> object(camera.width, camera.height, -1);

    // Hide the other segments behind an object.
    std::erase_if(hand->hand_pixels, [&](std::int32_t i) {
      if (shown(skin_->vertices[rendered.vertex[i]].a)) return false;
      hand->label[i] = PixelLabel::object;
      hand->depth[i] = 0.3F;
      object[i] = 0;
      rendered.vertex[i] = -1;
      return true;
    });

    // Update the maps that are derived from labels and skin.
    hand->nearest_hand = test::nearest_in(rendered.vertex);
    hand->nearest_object = test::nearest_in(object);
    hand_ = hand;
  }

  /// A pose as a search might find it: hidden joints have the flexion `hidden` [rad], and the knuckles are bent too far
  /// by `error` [rad].
  RefinedPose found(double hidden, double error) const {
    RefinedPose result;
    std::array<JointAngles, kSegmentCount> angles{};
    for (int s = 1; s < kSegmentCount; ++s) {
      angles[s] = joint_angles(*profile_, pose_, s);
      if (!shown(s)) angles[s].flexion = hidden;
      if (finger_of(s) > 0 && parent_of(s) == kPalm) angles[s].flexion += error;
    }
    result.pose = forward_kinematics(*profile_, pose_[kPalm], angles);
    result.score = refinement_.evaluate(*hand_, result.pose).score;
    for (int s = 0; s < kSegmentCount; ++s) result.visible[s] = shown(s);
    return result;
  }
  double flexion(const RefinedPose& of, int s) const { return joint_angles(*profile_, of.pose, s).flexion; }
  RefinedPose relaxed(const RefinedPose& found) const {
    return neutral_pose(*hand_, found, *profile_, refinement_, params_);
  }

  void expect_alike(const RefinedPose& pose) const {
    for (int finger = 1; finger < kFingerCount; ++finger) {
      const int root = segment_of(finger, 0), hidden = segment_of(finger, 1);
      EXPECT_NEAR(flexion(pose, root), joint_angles(*profile_, pose_, root).flexion, 2 * kDegree) << finger;
      EXPECT_NEAR(flexion(pose, hidden), flexion(pose, root), 3 * kDegree) << finger;
    }
  }

  const TrackerParams params_;
  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const std::shared_ptr<const Skin> skin_ = std::make_shared<const Skin>(make_blended_skin(*profile_, 0.004));
  const HandPose pose_ = test::facing_pose(*profile_, 0.5);
  const Refinement refinement_{params_.refinement, profile_, skin_};
  HandObservationPtr hand_;
};

TEST_F(RelaxedPose, BendsHiddenJointsLikeThoseBeforeThem) { expect_alike(relaxed(found(60 * kDegree, 0))); }

TEST_F(RelaxedPose, BendsThemLikeWhereThoseComeToLie) { expect_alike(relaxed(found(0, 15 * kDegree))); }

TEST_F(RelaxedPose, DiffersByWhatTheSensorCannotTell) {
  RefinedPose pose = found(0, 0);
  pose.score = 0;  // no pose has a better score
  HandObservation noisy = *hand_;
  noisy.noise = 0.02;  // m
  EXPECT_GT(neutral_pose(noisy, pose, *profile_, refinement_, params_).score, 0);
  noisy.noise = 0;
  EXPECT_EQ(neutral_pose(noisy, pose, *profile_, refinement_, params_).score, 0);
}

}  // namespace
}  // namespace barehand
