#include "object/distance_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/random.h"
#include "object/known_object.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kRadius = 0.04f;

Vector3f place(KeyedRandom& random, double reach) {
  return Vector3d(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach))
      .cast<float>();
}

TEST(DistanceGrid, KnowsTheDistancesOfABallInsideAndOutside) {
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(kRadius), 1);
  KeyedRandom random(1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3f p = place(random, 0.06);
    if (p.norm() < 0.02f) continue;  // at the middle all directions are equally near
    const auto sample = ball->grid.sample(p);
    EXPECT_NEAR(sample.distance, p.norm() - kRadius, 0.0012) << p.transpose();
    EXPECT_GT(sample.gradient.normalized().dot(p.normalized()), 0.97f) << p.transpose();
  }
}

TEST(DistanceGrid, TheGradientIsTheDerivative) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  constexpr float kStep = 2e-5f;
  KeyedRandom random(1, 2);
  int agree = 0, all = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3f p = place(random, 0.05);
    const auto sample = hammer->grid.sample(p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3f d = kStep * Vector3f::Unit(axis);
      const float slope = (hammer->grid.distance(p + d) - hammer->grid.distance(p - d)) / (2 * kStep);
      agree += std::abs(slope - sample.gradient[axis]) < 0.02f;
      ++all;
    }
  }
  EXPECT_GT(agree, 0.97 * all);  // at the border of two cells there is no derivative
}

TEST(DistanceGrid, BeyondTheGridDistancesGrowWithTheWay) {
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(kRadius), 1);
  EXPECT_NEAR(ball->grid.distance({0, 0, 0.5f}), 0.5f - kRadius, 0.002);
  EXPECT_GT(ball->grid.distance({0.3f, 0.3f, 0.3f}), 0.4f);
}

TEST(DistanceGrid, APlaceThatIsNoNumberHasNoDistance) {
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(kRadius), 1);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(ball->grid.distance({kNan, 0, 0})));
  EXPECT_TRUE(std::isnan(ball->grid.distance({kNan, kNan, kNan})));
}

TEST(KnownObject, SamplesCoverTheSurfaceEvenly) {
  const KnownObjectPtr box = make_known_object(test::box_mesh({0.1f, 0.05f, 0.02f}), 1);
  int front = 0;
  for (const SurfaceSample& sample : box->samples) {
    EXPECT_NEAR(box->grid.distance(sample.p), 0, 0.001);
    front += sample.n.z() < -0.5f;
  }
  const double share = 0.1 * 0.05 / (2 * (0.1 * 0.05 + 0.05 * 0.02 + 0.1 * 0.02));
  EXPECT_NEAR(static_cast<double>(front) / static_cast<double>(box->samples.size()), share, 0.01);
}

}  // namespace
}  // namespace barehand
