#include "stages/known_object/object_fit.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "math/random.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

const SE3 kPose{exp_so3({0.4, -0.3, 2.0}), {0.02, -0.03, 0.6}};

Vector6d random_twist(KeyedRandom& random, double shift, double turn) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-1, 1) * (i < 3 ? shift : turn);
  return twist;
}

/// The largest error of a gradient, compared with central differences, over many points; the worst tenth is left out,
/// because there is no derivative at the border of two cells.
double gradient_error(const DistanceGrid& grid, const std::function<Vector6d(const SurfaceResidual&)>& gradient) {
  constexpr double kStep = 1e-5;
  KeyedRandom random(3, 1);
  std::vector<double> errors;
  for (int i = 0; i < 300; ++i) {
    const Vector3f point =
        (kPose * Vector3d(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.03, 0.03)))
            .cast<float>();
    const Vector6d stated = gradient(surface_residual(grid, kPose, point));
    double error = 0;
    for (int k = 0; k < 6; ++k) {
      // The steps are large compared with the rounding of floats.
      const Vector6d step = kStep * (k < 3 ? 2 : 30) * Vector6d::Unit(k);
      const double slope = (surface_residual(grid, boxplus(kPose, step), point).value -
                            surface_residual(grid, boxplus(kPose, -step), point).value) /
                           (2 * step[k]);
      error = std::max(error, std::abs(slope - stated[k]));
    }
    errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() * 8 / 10];
}

TEST(ObjectFit, TheGradientIsTheDerivativeAndTheTestRejectsWrongOnes) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  EXPECT_LT(gradient_error(hammer->grid, [](const SurfaceResidual& r) { return r.gradient; }), 0.02);

  // Both halves with the wrong sign.
  const auto wrong = [](int half) {
    return [half](const SurfaceResidual& r) {
      Vector6d gradient = r.gradient;
      gradient.segment<3>(half) *= -1;
      return gradient;
    };
  };
  EXPECT_GT(gradient_error(hammer->grid, wrong(0)), 0.2);
  EXPECT_GT(gradient_error(hammer->grid, wrong(3)), 0.02);
}

/// The points of the surface that face the camera, with noise.
std::vector<Vector3f> seen_points(const KnownObject& object, const SE3& T, double noise) {
  KeyedRandom random(3, 2);
  std::vector<Vector3f> points;
  for (const SurfaceSample& sample : object.samples) {
    const Vector3d p = T * sample.p.cast<double>(), n = T.R * sample.n.cast<double>();
    if (n.dot(p) > -0.2 * p.norm()) continue;
    points.push_back((p + noise * random.normal() * p.normalized()).cast<float>());
  }
  return points;
}

TEST(ObjectFit, FindsThePoseFromNearby) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  const auto points = seen_points(*hammer, kPose, 0.001);
  KeyedRandom random(3, 3);
  for (int i = 0; i < 20; ++i) {
    const SE3 start = boxplus(kPose, random_twist(random, 0.008, 8 * kDegree));
    const FittedPose fitted = fit_pose(*hammer, points, 0.0015, start, {}, 20);
    EXPECT_LT((fitted.T_camera_object.t - kPose.t).norm(), 0.002) << i;
    EXPECT_LT(log_so3(fitted.T_camera_object.R * kPose.R.transpose()).norm(), 2 * kDegree) << i;
  }
}

TEST(ObjectFit, OutliersCountLittle) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  auto points = seen_points(*hammer, kPose, 0);
  for (std::size_t i = 0; i < points.size(); i += 5) points[i] *= 0.97f;  // fingers before it
  const FittedPose fitted = fit_pose(*hammer, points, 0.0015, kPose, {}, 20);
  EXPECT_LT((fitted.T_camera_object.t - kPose.t).norm(), 0.001);
}

TEST(ObjectFit, NoiseDoesNotPushAThinWallToTheCamera) {
  // Half of the points are behind the middle of the wall, and so nearer to its other side.
  const KnownObjectPtr plate = make_known_object(test::box_mesh({0.1f, 0.1f, 0.003f}), 1);
  const SE3 pose{exp_so3({0.3, -0.2, 0}), {0, 0, 0.6}};
  const auto points = seen_points(*plate, pose, 0.003);
  const FittedPose fitted = fit_pose(*plate, points, 0.003, pose, {pose, 1e6 * Matrix6d::Identity()}, 20, 1);
  const Vector3d normal = pose.R.col(2);
  EXPECT_LT(std::abs(normal.dot(fitted.T_camera_object.t - pose.t)), 0.0004);
}

TEST(ObjectFit, TheCovarianceSaysWhatNothingShows) {
  // A ball may turn as it likes.
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(0.035f), 1);
  const FittedPose fitted = fit_pose(*ball, seen_points(*ball, kPose, 0.001), 0.0015, kPose, {}, 20);
  EXPECT_LT(std::sqrt(fitted.covariance(2, 2)), 0.001);
  EXPECT_GT(std::sqrt(fitted.covariance(4, 4)), 5 * kDegree);
}

}  // namespace
}  // namespace barehand
