#include "stages/refinement/hand_contact.h"

#include <gtest/gtest.h>

#include "gradient_error.h"
#include "math/angles.h"
#include "stages/refinement/hand_energy.h"
#include "stages/search/start_templates.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

constexpr double kSigma = 0.001;

class Contact : public testing::TestWithParam<Handedness> {
 protected:
  void SetUp() override {
    profile_ = *test::adult_hand(GetParam());
    limits_ = widened_limits(profile_, 10 * kDegree);
  }
  HandPose pose_of(const std::array<JointAngles, kSegmentCount>& angles) const {
    return posed(profile_, {{palm_orientation(0.3, 0.2, 0.5), {0.02, -0.01, 0.5}}, angles});
  }
  /// Angles of a hand with the same flexions of all fingers [degrees] and a straight thumb.
  std::array<JointAngles, kSegmentCount> bent(double first, double second, double third) const {
    std::array<JointAngles, kSegmentCount> angles{};
    for (int finger = 1; finger < kFingerCount; ++finger) {
      angles[segment_of(finger, 0)].flexion = first * kDegree;
      angles[segment_of(finger, 1)].flexion = second * kDegree;
      angles[segment_of(finger, 2)].flexion = third * kDegree;
    }
    return angles;
  }
  /// A pose in which three fingers overlap.
  HandPose tangled() const {
    auto angles = bent(20, 25, 15);
    const double side = side_sign(profile_.handedness);
    angles[segment_of(1, 0)].abduction = -25 * side * kDegree;
    angles[segment_of(3, 0)].abduction = 20 * side * kDegree;
    return pose_of(angles);
  }
  double energy(const HandContact& contact, const HandPose& pose) const {
    GaussianTree unused;
    unused.set_zero();
    return contact.add_terms(pose, kSigma, unused);
  }

  HandProfile profile_;
  std::array<JointLimits, kSegmentCount> limits_{};
};

TEST_P(Contact, GradientMatchesCentralDifferences) {
  // The analytic gradient.
  const HandContact contact(profile_);
  const HandPose pose = tangled();
  ASSERT_GT(contact.deepest(pose), 0.003);
  GaussianTree tree;
  tree.set_zero();
  contact.add_terms(pose, kSigma, tree);

  // It must agree with central differences, and the check must notice a wrong one.
  const auto error = [&] {
    constexpr double kStep = 1e-6, kArm = 0.03;
    return test::gradient_error([&](const HandPose& at) { return energy(contact, at); }, pose, tree, kStep, kArm);
  };
  EXPECT_LT(error(), 1e-5);
  for (Vector6d& g : tree.g) g.tail<3>() *= 0.5;
  EXPECT_GT(error(), 0.01) << "the check must notice a wrong gradient";
}

// Minimises the energy of the refinement without data: the soft joints hold the hand together, and each step starts
// from the pose of the step before.
TEST_P(Contact, MovesSegmentsApartAndKeepsThemApart) {
  // The overlap at the start.
  const HandContact contact(profile_);
  HandPose pose = tangled();
  const EnergyParams params;
  std::array<double, kSegmentCount> seen;
  seen.fill(0);
  const double tangled_energy = energy(contact, pose);

  // Gauss-Newton steps.
  for (int step = 0; step < 8; ++step) {
    GaussianTree tree;
    tree.set_zero();
    contact.add_terms(pose, kSigma, tree);
    add_joint_terms(profile_, limits_, pose, params, tree);
    add_prior_terms(profile_, pose, seen, pose, params, tree);
    std::array<Vector6d, kSegmentCount> x;
    ASSERT_TRUE(tree.solve(x));
    for (int s = 0; s < kSegmentCount; ++s) pose[s] = boxplus(pose[s], x[s]);

    // The overlap shrinks at once and stays small.
    EXPECT_LT(energy(contact, pose), tangled_energy / 4) << step;
  }
  EXPECT_LT(contact.deepest(pose), 0.001);
}

TEST_P(Contact, FingersSideBySideDoNotOverlapHoweverTheyAreBent) {
  const HandContact contact(profile_);
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
    EXPECT_LT(contact.deepest(pose_of(bent(80 * share, 100 * share, 60 * share))), 0.0005) << share;
}

TEST_P(Contact, FingertipsDoNotPassThroughThePalm) {
  const HandContact contact(profile_);
  EXPECT_GT(contact.deepest(pose_of(bent(100, 125, 40))), 0.003);
}

INSTANTIATE_TEST_SUITE_P(BothHands, Contact, testing::Values(Handedness::right, Handedness::left),
                         [](const auto& info) { return std::string(to_string(info.param)); });

}  // namespace
}  // namespace barehand
