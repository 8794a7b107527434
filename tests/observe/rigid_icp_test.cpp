#include "observe/registration/rigid_icp.h"

#include <gtest/gtest.h>

#include "math/random.h"
#include "stages/prediction/motion_prediction.h"
#include "stages/search/start_templates.h"
#include "support/point_world.h"

namespace barehand {
namespace {

constexpr double kFrame = 1.0 / 30;

/// Largest deviation of the columns of `jacobian` from central differences of the residual.
double jacobian_error(const SE3& T, const IcpPair& pair, const Eigen::Matrix<double, 4, 6>& jacobian) {
  constexpr double kStep = 1e-6;
  double worst = 0;
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = kStep * Vector6d::Unit(k);
    const Eigen::Vector4d numeric =
        (icp_residual(boxplus(T, step), pair).value - icp_residual(boxplus(T, -step), pair).value) / (2 * kStep);
    worst = std::max(worst, (numeric - jacobian.col(k)).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(IcpResidual, JacobianMatchesDifferencesAndAWrongOneDoesNot) {
  const SE3 T{exp_so3({0.3, -0.8, 1.2}), {0.1, -0.05, 0.5}};
  const IcpPair pair{{0.03, -0.07, 0.02}, {0.12, 0.0, 0.48}, Eigen::Vector3d(0.2, 0.5, -0.8).normalized()};
  const Eigen::Matrix<double, 4, 6> jacobian = icp_residual(T, pair).jacobian;
  EXPECT_LT(jacobian_error(T, pair, jacobian), 1e-8);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 6; ++column) {
      if (std::abs(jacobian(row, column)) < 1e-6) continue;
      Eigen::Matrix<double, 4, 6> wrong = jacobian;
      wrong(row, column) *= -1;
      EXPECT_GT(jacobian_error(T, pair, wrong), 1e-4) << row << ", " << column;
    }
  }
}

TEST(ObservedCloud, AnyGuessLeadsToTheNearestPoint) {
  const auto profile = test::adult_hand();
  ArticulatedPose shape{{palm_orientation(0.2, 0.3, 0.4), {0.02, 0.05, 0.4}}, {}};
  shape.angles = shape_templates(*profile, widened_limits(*profile, 0.1))[2].angles;
  const auto observation = test::PointWorld(*profile).observe(posed(*profile, shape));
  const ObservedCloud cloud(*observation);
  ASSERT_GT(cloud.size(), 200u);
  KeyedRandom random(1, 0);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p =
        cloud.centroid() + 0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    double nearest = INFINITY;
    for (std::size_t k = 0; k < cloud.size(); ++k) nearest = std::min(nearest, (cloud.point(k) - p).norm());
    const auto guess = static_cast<std::size_t>(random.uniform() * static_cast<double>(cloud.size()));
    EXPECT_NEAR((cloud.point(cloud.nearest(p, guess)) - p).norm(), nearest, 1e-6);
  }
}

class RigidIcp : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(profile_);
    surface_ = make_cylinder_surface(*profile_, 400);
    ArticulatedPose start{{palm_orientation(0.2, 0.3, 0.4), {0.02, 0.05, 0.4}}, {}};
    start.angles = shape_templates(*profile_, widened_limits(*profile_, 0.1))[2].angles;
    before_ = posed(*profile_, start);
    model_ = visible_points_.of(surface_, before_, test::small_camera(), params_.model_points);
    centre_ = before_[kPalm] * Eigen::Vector3d(0, 0, -0.07);
  }
  /// Rotation by the vector `w` [rad] about the middle of the palm, followed by a shift [m].
  SE3 motion(const Eigen::Vector3d& w, const Eigen::Vector3d& shift) const {
    const Eigen::Matrix3d R = exp_so3(w);
    return {R, centre_ - R * centre_ + shift};
  }
  /// Aligns the model with the cloud of the next frame.
  IcpResult align(const ObservedCloud& cloud, const SE3& last_motion) const {
    return align_rigid(model_, cloud, last_motion, motion_bound(params_, kFrame), params_);
  }
  double error_of(const IcpResult& result, const SE3& truth) const {
    return test::mean_error(*profile_, moved(result.motion, before_), moved(truth, before_));
  }

  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  HandSurface surface_;
  HandPose before_;
  IcpParams params_;
  VisiblePoints visible_points_;
  std::span<const OrientedPoint> model_;
  Eigen::Vector3d centre_;
};

TEST_F(RigidIcp, RecoversLargeMotions) {
  const test::PointWorld world(*profile_);
  const double angle = 25 * std::numbers::pi / 180;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const std::vector<SE3> motions = {motion({0, 0, 0}, {0.03, 0, 0}),       motion({0, 0, 0}, {0, -0.02, 0.02}),
                                    motion(angle * z, {0.02, 0.02, 0}),    motion(-angle * z, {-0.02, 0, 0.02}),
                                    motion(0.7 * angle * x, {0, 0.03, 0}), motion(0.7 * angle * y, {0, 0, 0.03})};
  for (const SE3& truth : motions) {
    const auto observation = world.observe(moved(truth, before_));
    const ObservedCloud cloud(*observation);
    const IcpResult result = align(cloud, SE3{});
    EXPECT_TRUE(result.reliable);
    EXPECT_LT(error_of(result, truth), 0.003) << boxminus(truth, SE3{}).transpose();
    EXPECT_LT(result.rms, 0.003);
  }
}

TEST_F(RigidIcp, LastMotionCarriesThroughWhereOtherStartsFail) {
  const test::PointWorld world(*profile_);
  const SE3 truth = motion({0, 0, 1.4}, {0.05, 0.0, 0});
  const auto observation = world.observe(moved(truth, before_));
  const ObservedCloud cloud(*observation);
  params_.max_angular_speed = 60;
  const SE3 almost = motion({0, 0, 1.2}, {0.04, 0.01, 0});
  EXPECT_LT(error_of(align(cloud, almost), truth), 0.003);
}

TEST_F(RigidIcp, OutliersDoNotPull) {
  const test::PointWorld world(*profile_);
  const SE3 truth = motion({0, 0, 0.2}, {0.015, -0.01, 0.01});
  const auto observation = world.observe(moved(truth, before_));
  KeyedRandom random(3, 0);
  const std::size_t outliers = observation->cloud.size() / 4;
  for (std::size_t i = 0; i < outliers; ++i) {
    observation->cloud.emplace_back(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), random.uniform(0.3, 0.5));
  }
  EXPECT_LT(error_of(align(ObservedCloud(*observation), SE3{}), truth), 0.005);
}

TEST_F(RigidIcp, PartialOcclusionDoesNotPull) {
  const test::PointWorld world(*profile_);
  const SE3 truth = motion({0, 0.1, 0.15}, {0.01, -0.01, 0.01});
  const auto observation = world.observe(moved(truth, before_));
  const std::size_t all = observation->cloud.size();
  test::PointWorld::occlude(*observation, 177, 0.3f);
  ASSERT_LT(observation->cloud.size(), 0.75 * all);
  EXPECT_LT(error_of(align(ObservedCloud(*observation), SE3{}), truth), 0.005);
}

TEST_F(RigidIcp, HoldsWithTooFewPoints) {
  HandObservation observation = *test::PointWorld(*profile_).observe(before_);
  observation.cloud.resize(params_.min_points - 1);
  const IcpResult result = align(ObservedCloud(observation), SE3{});
  EXPECT_FALSE(result.reliable);
  EXPECT_LT(boxminus(result.motion, SE3{}).norm(), 1e-15);
}

TEST_F(RigidIcp, HoldsWhenTheMotionIsNotBelievable) {
  const test::PointWorld world(*profile_);
  params_.max_speed = 0.5;
  params_.slack = 0.01;
  const auto observation = world.observe(moved(motion({0, 0, 0}, {-0.06, -0.03, 0}), before_));
  const ObservedCloud cloud(*observation);
  const IcpResult result = align(cloud, SE3{});
  EXPECT_LT(boxminus(result.motion, SE3{}).head<3>().norm(), 0.5 * kFrame + 0.01 + 1e-9);
}

TEST_F(RigidIcp, HoldsWhenLittleOfTheModelMatches) {
  HandObservation observation = *test::PointWorld(*profile_).observe(before_);
  std::erase_if(observation.cloud, [](const Eigen::Vector3f& p) { return p.x() > 0.02f; });
  ASSERT_GT(static_cast<int>(observation.cloud.size()), params_.min_points);
  params_.min_inliers = 0.9;
  EXPECT_FALSE(align(ObservedCloud(observation), SE3{}).reliable);
}

}  // namespace
}  // namespace barehand
