#include "object/round_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/random.h"
#include "math/se3.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.036, kLength = 0.1;                   // [m]
const SE3 kPlace{exp_so3({0.4, -0.7, 0.3}), {0.02, -0.01, 0.03}};  // where the shapes are

using Surface = std::vector<SurfaceSample>;

/// Adds a place with its normal, of a shape at the origin, with noise along the normal [m].
void add(Surface& surface, const Vector3d& p, const Vector3d& n, double noise) {
  const Vector3d at = kPlace * Vector3d(p + noise * n);
  surface.push_back({at.cast<float>(), (kPlace.R * n).cast<float>()});
}

/// The part of a ball within `reach` [rad] of the direction in which it is seen, -z.
Surface ball(double reach, double noise, double radius = kRadius) {
  Surface surface;
  KeyedRandom random(3, 1);
  while (surface.size() < 300) {
    const Vector3d n = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    if (std::acos(-n.z()) < reach) add(surface, radius * n, n, noise * random.normal());
  }
  return surface;
}

/// The part of the side of a cylinder along y within `reach` [rad] of -z. `inwards`: seen from within.
Surface cylinder(double reach, double noise, double radius = kRadius, bool inwards = false) {
  Surface surface;
  KeyedRandom random(3, 2);
  for (int i = 0; i < 500; ++i) {
    const double angle = random.uniform(-reach, reach), y = random.uniform(-0.5, 0.5) * kLength;
    const Vector3d n(std::sin(angle), 0, -std::cos(angle));
    add(surface, radius * n + y * Vector3d::UnitY(), inwards ? Vector3d(-n) : n, noise * random.normal());
  }
  return surface;
}

/// The sides of a box of this size that show themselves to a camera above one of its corners.
Surface box(double size) {
  Surface surface;
  KeyedRandom random(3, 3);
  for (int i = 0; i < 600; ++i) {
    Vector3d p(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    p[i % 3] = -0.5;
    add(surface, size * p, -Vector3d::Unit(i % 3), 0);
  }
  return surface;
}

TEST(RoundShape, ABallIsFoundExactlyFromALittleOfIt) {
  const auto shape = fit_round_shape(ball(0.6, 0));
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->half_length, 0);
  EXPECT_NEAR(shape->radius, kRadius, 1e-5);
  EXPECT_LT((shape->centre - kPlace.t).norm(), 1e-5);
}

TEST(RoundShape, ACylinderIsFoundExactly) {
  const auto shape = fit_round_shape(cylinder(0.9, 0));
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->radius, kRadius, 1e-5);
  EXPECT_NEAR(std::abs(shape->axis.dot(kPlace.R.col(1))), 1, 1e-8);
  EXPECT_NEAR(shape->half_length, kLength / 2, 1e-3);
  EXPECT_LT((shape->centre - kPlace.t).norm(), 1e-3);  // along the axis, samples are random
}

TEST(RoundShape, NoiseMovesTheFarSideByAboutItsDeviation) {
  for (const Surface& seen : {ball(1, 0.0005), cylinder(1, 0.0005)}) {
    const auto shape = fit_round_shape(seen);
    ASSERT_TRUE(shape);
    const Vector3d far = kPlace * Vector3d(0, 0, kRadius);
    EXPECT_LT(std::abs(shape->distance(far)), 2 * shape->deviation);
    EXPECT_LT(shape->deviation, 0.004);
  }
}

/// Mean squared distance of samples from the side of a shape.
double misfit(const RoundShape& shape, const Surface& surface) {
  double sum = 0;
  for (const SurfaceSample& sample : surface) {
    const Vector3d q = sample.p.cast<double>() - shape.centre;
    const double distance = (q - shape.axis * shape.axis.dot(q)).norm() - shape.radius;
    sum += distance * distance;
  }
  return sum / static_cast<double>(surface.size());
}

TEST(RoundShape, NoOtherShapeNearbyFitsBetter) {
  // A step that goes the wrong way in one of the unknowns ends elsewhere.
  for (const Surface& seen : {ball(1, 0.0003), cylinder(1, 0.0003)}) {
    const RoundShape shape = *fit_round_shape(seen);
    const double least = misfit(shape, seen);
    for (const double sign : {-1.0, 1.0}) {
      RoundShape other = shape;
      other.radius += sign * 2e-4;
      EXPECT_GT(misfit(other, seen), least) << "radius";
      for (int k = 0; k < 3; ++k) {
        other = shape;
        const Vector3d step = sign * Vector3d::Unit(k);
        other.centre += 2e-4 * (step - shape.axis * shape.axis.dot(step));
        EXPECT_GT(misfit(other, seen), least) << "centre";
        if (shape.half_length == 0) continue;
        other = shape;
        other.axis = exp_so3(0.01 * step.cross(shape.axis)) * shape.axis;
        EXPECT_GT(misfit(other, seen), least) << "axis";
      }
    }
  }
}

TEST(RoundShape, TheLessIsSeenTheLessIsKnownOfTheFarSide) {
  EXPECT_GT(fit_round_shape(ball(0.4, 0))->deviation, 2 * fit_round_shape(ball(1.2, 0))->deviation);
  EXPECT_GT(fit_round_shape(cylinder(0.5, 0))->deviation, 2 * fit_round_shape(cylinder(1.2, 0))->deviation);
}

TEST(RoundShape, TheInsideOfAMugShowsItsOutside) {
  const auto shape = fit_round_shape(cylinder(0.9, 0, kRadius - 0.003, true));
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->radius, kRadius, 0.001);
}

TEST(RoundShape, AMugIsAsThickAsItsOutsideWhateverElseItShows) {
  // It shows its inside and a handle, too.
  Surface mug = cylinder(1.2, 0);
  const Surface inside = cylinder(1, 0, kRadius - 0.003, true);
  mug.insert(mug.end(), inside.begin(), inside.end());
  for (int i = 0; i < 80; ++i) add(mug, {kRadius + 0.0003 * i, 0.01 * std::sin(i), 0}, -Vector3d::UnitZ(), 0);
  const auto shape = fit_round_shape(mug);
  ASSERT_TRUE(shape);
  EXPECT_NEAR(shape->radius, kRadius, 1e-4);
  EXPECT_NE(shape->half_length, 0);
}

TEST(RoundShape, NothingElseIsRound) {
  EXPECT_FALSE(fit_round_shape({}));
  EXPECT_FALSE(fit_round_shape(box(0.017))) << "a die";
  EXPECT_FALSE(fit_round_shape(box(0.07))) << "a carton";
  EXPECT_FALSE(fit_round_shape(ball(0.5, 0, 0.12))) << "larger than a hand closes around";
  EXPECT_FALSE(fit_round_shape(cylinder(1, 0, 0.004))) << "thinner than a pencil";
  EXPECT_FALSE(fit_round_shape(ball(1, 0.003))) << "too uneven";
  const Surface few = ball(1, 0);
  EXPECT_FALSE(fit_round_shape(std::span(few).first(20)));
}

TEST(RoundShape, TheObjectHasItsDistances) {
  for (const Surface& seen : {ball(1, 0), cylinder(1, 0)}) {
    const RoundShape shape = *fit_round_shape(seen);
    const KnownObjectPtr object = make_round_object(shape, 1234);
    EXPECT_EQ(object->id, 1234);
    KeyedRandom random(1, 1);
    for (int i = 0; i < 500; ++i) {
      const Vector3d p =
          kPlace.t + 0.09 * Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double distance = shape.distance(p);
      if (distance > 0.02 || distance < -0.01) continue;  // the grid ends, or the distance has no direction
      EXPECT_NEAR(object->grid.distance(p.cast<float>()), distance, 0.001);
    }
  }
}

TEST(RoundShape, TheDistanceFromACylinderIsRightOnAllSidesOfItsEnds) {
  RoundShape shape;
  shape.axis = Vector3d::UnitY();
  shape.radius = 0.03;
  shape.half_length = 0.05;
  EXPECT_NEAR(shape.distance({0.05, 0, 0}), 0.02, 1e-12);
  EXPECT_NEAR(shape.distance({0, -0.06, 0}), 0.01, 1e-12);
  EXPECT_NEAR(shape.distance({0.06, 0.09, 0}), 0.05, 1e-12);
  EXPECT_NEAR(shape.distance({0.01, 0.045, 0}), -0.005, 1e-12);
}

}  // namespace
}  // namespace barehand
