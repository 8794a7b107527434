#include "stages/refinement/residual_moments.h"

#include <gtest/gtest.h>

#include "math/random.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

Vector3d random_vector(KeyedRandom& random, double scale) {
  return scale * Vector3d(random.normal(), random.normal(), random.normal());
}

TEST(ResidualMoments, EqualTheSumOfEveryPointsJacobian) {
  KeyedRandom random(1, 5);
  HandPose pose;
  for (SE3& T : pose) T.t = Vector3d(0, 0, 0.5) + random_vector(random, 0.05);
  ResidualMoments moments(pose);
  GaussianTree expected, actual;
  expected.set_zero();
  actual.set_zero();

  // Random residuals on rigid and on blended skin.
  for (int i = 0; i < 200; ++i) {
    SkinVertex v;
    v.a = static_cast<std::int16_t>(1 + i % (kSegmentCount - 1));
    v.b = static_cast<std::int16_t>(i % 3 == 0 ? v.a : parent_of(v.a));
    if (i % 3 == 2) std::swap(v.a, v.b);
    v.weight_b = v.a == v.b ? 0 : 0.3f;
    const Vector3d p = Vector3d(0, 0, 0.5) + random_vector(random, 0.05);
    const Vector3d direction = random_vector(random, 1).normalized();
    const double r = random.normal() * 0.003, w = 1e5 * random.uniform();
    moments.add(v, p.cast<float>(), direction.cast<float>(), static_cast<float>(r), static_cast<float>(w));

    // Compute the same sums from the Jacobian of each point.
    const auto row = [&](int s, double share) {
      Vector6d j;  // d . d(R x + t)/d(v, w)
      j.head<3>() = share * direction;
      j.tail<3>() = share * (p - pose[s].t).cross(direction);
      return j;
    };
    const Vector6d a = row(v.a, 1 - v.weight_b), b = row(v.b, v.weight_b);
    expected.H_self[v.a] += w * a * a.transpose();
    expected.g[v.a] -= w * r * a;
    if (v.a == v.b) continue;
    expected.H_self[v.b] += w * b * b.transpose();
    expected.g[v.b] -= w * r * b;
    const bool a_is_child = parent_of(v.a) == v.b;
    expected.H_parent[a_is_child ? v.a : v.b] += w * (a_is_child ? a * b.transpose() : b * a.transpose());
  }

  // Both sums agree in single precision.
  moments.add_to(actual);
  for (int s = 0; s < kSegmentCount; ++s) {
    EXPECT_TRUE(actual.H_self[s].isApprox(expected.H_self[s], 1e-5)) << s;
    EXPECT_TRUE(actual.g[s].isApprox(expected.g[s], 1e-5)) << s;
    if (s == kPalm) continue;
    EXPECT_TRUE(actual.H_parent[s].isApprox(expected.H_parent[s], 1e-5)) << s;
  }
}

}  // namespace
}  // namespace barehand
