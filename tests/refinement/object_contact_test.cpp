#include "stages/refinement/object_contact.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gradient_error.h"
#include "hand/articulated_pose.h"
#include "hand/skin.h"
#include "math/angles.h"
#include "stages/refinement/hand_energy.h"
#include "support/adult_hand.h"
#include "support/painted_hand.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

constexpr int kTip = segment_of(0, 2);

class ObjectContactTest : public testing::Test {
 protected:
  ObjectContactTest() { hidden_.fill(1); }

  /// A ball whose surface is about `gap` [m] from the pad of a fingertip, here of the thumb.
  NearbyObject ball_at_the_pad(double gap, std::int32_t hand_id, int of_tip = kTip) const {
    const SE3& tip = pose_[of_tip];
    const SegmentProfile& segment = profile_->segments[of_tip];
    NearbyObject ball{ball_, {Eigen::Matrix3d::Identity(), tip * Eigen::Vector3d(0.8 * segment.distal)}};
    ball.T_base_object.t -= (kRadius + gap + segment.half_thickness[1]) * tip.R.col(1);
    if (hand_id >= 0) ball.T_base_object = pose_[kPalm].inverse() * ball.T_base_object;
    ball.hand_id = hand_id;
    ball.holder_id = hand_id;
    return ball;
  }
  /// A wall whose surface is about `gap` [m] from the pad of the index finger, and parallel to it.
  NearbyObject wall_at_the_pads(double gap, bool held) const {
    const int index = segment_of(1, 2);
    const SegmentProfile& segment = profile_->segments[index];
    const SE3& tip = pose_[index];
    NearbyObject wall{wall_, {tip.R, tip * Eigen::Vector3d(0.8 * segment.distal)}};
    wall.T_base_object.t -= (kWall / 2 + gap + segment.half_thickness[1]) * tip.R.col(1);
    wall.holder_id = held ? 1 : -1;
    return wall;
  }
  double energy(const HandPose& pose, const NearbyObject& object) const {
    GaussianTree unused;
    unused.set_zero();
    return contact_.add_terms(pose, {&object, 1}, hidden_, unused).energy;
  }
  /// How firmly each hidden fingertip rests on an object.
  std::array<double, kFingerCount> rests(const NearbyObject& object) const {
    GaussianTree unused;
    unused.set_zero();
    return contact_.add_terms(pose_, {&object, 1}, hidden_, unused).rests;
  }
  /// The signed distance of a segment, here of the thumb's last one, from an object [m].
  double distance(const HandPose& pose, const NearbyObject& object, int segment = kTip) const {
    const SE3 T_object_segment = object.pose(pose[kPalm]).inverse() * pose[segment];
    const SegmentSurface& skin = surface_[segment];
    double least = 1;
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Eigen::Vector3d p = T_object_segment * Eigen::Vector3d(skin.x[i], skin.y[i], skin.z[i]);
      least = std::min<double>(least, object.object->grid.distance(p.cast<float>()));
    }
    return least;
  }
  /// The object where it is at this pose, although the palm moves by a step of a numeric derivative.
  double energy_with_object_at_rest(const HandPose& pose, NearbyObject object) const {
    if (object.hand_id >= 0) object.T_base_object = pose[kPalm].inverse() * pose_[kPalm] * object.T_base_object;
    return energy(pose, object);
  }
  double gradient_error(const NearbyObject& object, const GaussianTree& tree) const {
    constexpr double kStep = 4e-5, kArm = 0.03;  // steps are large compared with the rounding of floats
    return test::gradient_error([&](const HandPose& at) { return energy_with_object_at_rest(at, object); }, pose_, tree,
                                kStep, kArm);
  }

  static constexpr float kRadius = 0.012f, kWall = 0.02f;  // radius of the ball, thickness of the wall [m]
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  HandPose pose_ = test::facing_pose(*profile_, 0.45, 0.35);
  KnownObjectPtr ball_ = make_known_object(test::ball_mesh(kRadius), 1);
  KnownObjectPtr wall_ = make_known_object(test::box_mesh({0.2f, kWall, 0.1f}), 2);
  std::array<double, kSegmentCount> hidden_{};
  HandSurface surface_ = surface_points(make_blended_skin(*profile_, 0.004), *profile_, 60);
  ObjectContact contact_{{}, surface_};
};

TEST_F(ObjectContactTest, GradientsMatchCentralDifferencesAndWrongOnesAreRejected) {
  for (const auto& [gap, hand] : {std::pair{-0.005, -1}, {-0.005, 1}}) {
    const NearbyObject object = ball_at_the_pad(gap, hand);
    GaussianTree tree;
    tree.set_zero();
    ASSERT_GT(contact_.add_terms(pose_, {&object, 1}, hidden_, tree).energy, 0.1) << gap << " " << hand;
    EXPECT_LT(gradient_error(object, tree), 0.03) << gap << " " << hand;

    // Wrong translations, and wrong rotations.
    GaussianTree wrong = tree;
    for (Vector6d& g : wrong.g) g.head<3>() *= -1;
    EXPECT_GT(gradient_error(object, wrong), 0.5);
    wrong = tree;
    for (Vector6d& g : wrong.g) g.tail<3>() *= -1;
    EXPECT_GT(gradient_error(object, wrong), 0.1);
  }
}

TEST_F(ObjectContactTest, TheDrawIsTheDerivativeAlongThePad) {
  // How well the pad faces the object weights the draw, and counts as fixed in a step: move along that direction only.
  NearbyObject ball = ball_at_the_pad(0.008, -1);
  ball.holder_id = 1;
  GaussianTree tree;
  tree.set_zero();
  contact_.add_terms(pose_, {&ball, 1}, hidden_, tree);
  const Eigen::Vector3d dorsal = pose_[kTip].R.col(1), place = ball.T_base_object.t;
  const double derivative = -2 * tree.g[kTip].head<3>().dot(dorsal);

  // The tip moves away from the ball as the ball moves away from it.
  constexpr double kStep = 1e-4;
  ball.T_base_object.t = place - kStep * dorsal;
  const double farther = energy(pose_, ball);
  ball.T_base_object.t = place + kStep * dorsal;
  EXPECT_NEAR((farther - energy(pose_, ball)) / (2 * kStep) / derivative, 1, 0.05);
}

TEST_F(ObjectContactTest, OnlyHiddenTipsOfTheHandThatHoldsItAreDrawnToAnObject) {
  const NearbyObject held = ball_at_the_pad(0.008, 1), free = ball_at_the_pad(0.008, -1);
  EXPECT_GT(energy(pose_, held), 0.1);
  EXPECT_EQ(energy(pose_, free), 0);
  hidden_.fill(0);
  EXPECT_EQ(energy(pose_, held), 0);

  // The tree has terms of tips alone.
  hidden_.fill(1);
  GaussianTree tree;
  tree.set_zero();
  contact_.add_terms(pose_, {&held, 1}, hidden_, tree);
  EXPECT_GT(tree.g[kTip].norm(), 0);
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_TRUE(is_tip(s) || tree.g[s].norm() == 0) << s;
}

TEST_F(ObjectContactTest, TipsThatAreSeenShowWhetherTheHandGrips) {
  // The index fingertip, which is seen, touches a wall or not; so does that of the middle finger, which is hidden.
  const int index = segment_of(1, 2);
  hidden_[index] = 0;
  EXPECT_GT(rests(wall_at_the_pads(0.001, false))[2], 0.5);
  EXPECT_GT(rests(wall_at_the_pads(0.001, true))[2], 0.5);
  EXPECT_EQ(rests(wall_at_the_pads(0.012, true))[2], 0);

  // No tip is seen.
  hidden_[index] = 1;
  EXPECT_GT(rests(wall_at_the_pads(0.001, true))[2], 0.5);
  EXPECT_EQ(rests(wall_at_the_pads(0.001, false))[2], 0);

  // The little finger shows that the hand is open.
  hidden_[segment_of(4, 2)] = 0;
  EXPECT_EQ(energy(pose_, ball_at_the_pad(0.008, 1)), 0);
}

TEST_F(ObjectContactTest, OnlyPadsAreDrawnToAnObject) {
  const SE3& tip = pose_[kTip];
  NearbyObject ball = ball_at_the_pad(0.008, -1);
  ball.holder_id = 1;
  const double at_the_pad = energy(pose_, ball);
  EXPECT_GT(at_the_pad, 0.1);

  // The same ball on the back of the tip, and on both of its sides.
  const SegmentProfile& segment = profile_->segments[kTip];
  const Eigen::Vector3d middle = tip * Eigen::Vector3d(0.8 * segment.distal);
  ball.T_base_object.t = middle + (middle - ball.T_base_object.t);
  EXPECT_EQ(energy(pose_, ball), 0);
  for (const int side : {-1, 1}) {
    ball.T_base_object.t = middle + side * (kRadius + 0.008 + segment.half_width[1]) * tip.R.col(0);
    EXPECT_LT(energy(pose_, ball), 0.3 * at_the_pad) << side;
  }
}

TEST_F(ObjectContactTest, OnlyTipsNearTheSurfaceRestOnAnObject) {
  EXPECT_GT(rests(ball_at_the_pad(0.001, 1))[0], 0.9);
  EXPECT_EQ(rests(ball_at_the_pad(-0.002, 1))[0], 1);
  EXPECT_LT(rests(ball_at_the_pad(0.02, 1))[0], 0.5);
  EXPECT_EQ(rests(ball_at_the_pad(0.001, 1))[3], 0) << "the ring finger is far away";
  hidden_[kTip] = 0;
  EXPECT_EQ(rests(ball_at_the_pad(0.001, 1))[0], 0) << "the thumb is seen";
}

TEST_F(ObjectContactTest, AnObjectOutOfReachAddsNothing) {
  NearbyObject object = ball_at_the_pad(0, -1);
  object.holder_id = 1;
  object.T_base_object.t.z() += 0.3;
  EXPECT_EQ(energy(pose_, object), 0);
}

TEST_F(ObjectContactTest, HiddenFingersCloseUntilTheirSkinTouches) {
  // A wall across the way of the fingers, 25 mm in front of the index fingertip, which is open.
  ArticulatedPose open{{pose_[kPalm].R, pose_[kPalm].t}, {}};
  pose_ = posed(*profile_, open);
  const auto limits = widened_limits(*profile_, 10 * kDegree);
  const NearbyObject wall = wall_at_the_pads(0.025, true);
  const auto closed = contact_.closed(*profile_, limits, pose_, {&wall, 1}, hidden_);
  EXPECT_FALSE(closed[0]) << "the thumb";
  for (int finger = 1; finger < kFingerCount; ++finger) {
    ASSERT_TRUE(closed[finger]) << finger;
    ArticulatedPose bent = open;
    for (int k = 0; k < 3; ++k) bent.angles[segment_of(finger, k)].flexion = (*closed[finger])[k];
    const HandPose at_the_wall = posed(*profile_, bent);
    double least = 1;
    for (int k = 0; k < 3; ++k) least = std::min(least, distance(at_the_wall, wall, segment_of(finger, k)));
    EXPECT_NEAR(least, 0, 0.0025) << finger;  // a joint turns by 0.01 rad a step
  }
}

TEST_F(ObjectContactTest, OnlyHiddenFingersThatReachAGrippedObjectClose) {
  pose_ = posed(*profile_, {{pose_[kPalm].R, pose_[kPalm].t}, {}});
  const auto limits = widened_limits(*profile_, 10 * kDegree);
  const auto closes = [&](const NearbyObject& object, int finger) {
    return contact_.closed(*profile_, limits, pose_, {&object, 1}, hidden_)[finger].has_value();
  };
  const NearbyObject wall = wall_at_the_pads(0.025, true);
  EXPECT_TRUE(closes(wall, 2));

  // One that is not held, is touched by straight fingers, or is out of reach.
  EXPECT_FALSE(closes(wall_at_the_pads(0.025, false), 2));
  EXPECT_FALSE(closes(wall_at_the_pads(-0.005, true), 2));
  NearbyObject behind = wall;
  behind.T_base_object.t += 0.15 * pose_[kPalm].R.col(1);
  EXPECT_FALSE(closes(behind, 2));

  // A finger that is seen to its tip stays; of one whose first segment is seen, the others close.
  hidden_[segment_of(2, 2)] = 0;
  EXPECT_FALSE(closes(wall, 2));
  hidden_[segment_of(2, 2)] = 1;
  hidden_[segment_of(2, 0)] = 0;
  const auto closed = contact_.closed(*profile_, limits, pose_, {&wall, 1}, hidden_);
  ASSERT_TRUE(closed[2]);
  EXPECT_NEAR((*closed[2])[0], 0, 1e-9);
  EXPECT_GT((*closed[2])[1], 0.2);
}

TEST_F(ObjectContactTest, OneTipOfSeveralThatAreSeenShowsNoGrip) {
  // The hand reaches for a ball at its index fingertip; its little finger, far from the ball, is seen, too.
  const int index = segment_of(1, 2);
  const NearbyObject ball = ball_at_the_pad(0.001, -1, index);
  hidden_[index] = 0;
  const double gripped = std::ranges::max(rests(ball));
  hidden_[segment_of(4, 2)] = 0;
  EXPECT_EQ(std::ranges::max(rests(ball)), 0);
  EXPECT_GT(gripped, 0) << "without the little finger, the tip that is seen decides";
}

// Minimises the energy of the refinement without data: the soft joints hold the hand together, and each step starts
// from the pose of the step before.
TEST_F(ObjectContactTest, FingersLeaveTheObjectAndHiddenTipsComeToIt) {
  const auto limits = widened_limits(*profile_, 10 * kDegree);
  std::array<double, kSegmentCount> seen;
  seen.fill(0);
  for (const double gap : {-0.008, 0.012}) {
    const NearbyObject object = ball_at_the_pad(gap, 1);
    HandPose pose = pose_;
    for (int step = 0; step < 40; ++step) {
      GaussianTree tree;
      tree.set_zero();
      contact_.add_terms(pose, {&object, 1}, hidden_, tree);
      add_joint_terms(*profile_, limits, pose, {}, tree);
      add_prior_terms(*profile_, pose, seen, pose, {}, tree);
      tree.H_self[kPalm].diagonal().array() += 1e9;  // the palm is seen
      std::array<Vector6d, kSegmentCount> x;
      ASSERT_TRUE(tree.solve(x));
      for (int s = 0; s < kSegmentCount; ++s) pose[s] = boxplus(pose[s], x[s]);
    }
    EXPECT_GT(std::abs(distance(pose_, object)), 0.005) << gap;
    EXPECT_NEAR(distance(pose, object), 0, 0.002) << gap;
  }
}

}  // namespace
}  // namespace barehand
