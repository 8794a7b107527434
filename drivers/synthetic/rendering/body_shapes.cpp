// Meshes of a simulated person's body parts.
#include "drivers/synthetic/rendering/body_shapes.h"

#include <cmath>
#include <numbers>

#include "drivers/synthetic/rendering/shapes.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;
constexpr int kColumns = 32;
constexpr int kCapRings = 8;
constexpr double kQuarter = std::numbers::pi / 2;

/// Adds the rings of a hemisphere with its equator at `z`: for `side` -1 the lower one, from its pole to the equator;
/// for +1 the upper one, from the equator to its pole.
void add_cap(std::vector<LoftRing>& rings, double z, double radius, int side) {
  for (int i = 0; i <= kCapRings; ++i) {
    const double angle = kQuarter * (side < 0 ? kCapRings - i : i) / kCapRings;
    const double across = radius * std::max(std::cos(angle), 1e-3);  // a pole is a very small ring
    rings.push_back({{0, 0, z + side * radius * std::sin(angle)}, across, across});
  }
}

}  // namespace

TriangleMesh make_loft(std::span<const LoftRing> rings) {
  const int rows = static_cast<int>(rings.size()) - 1;
  return make_patch(
      kColumns, rows,
      [&](double u, double v) {
        const LoftRing& ring = rings[static_cast<std::size_t>(std::lround(v * rows))];
        const double angle = 4 * kQuarter * u;
        return Vector3d(ring.centre + Vector3d(ring.half_x * std::cos(angle), ring.half_y * std::sin(angle), 0));
      },
      true);
}

TriangleMesh make_ellipsoid(const Vector3d& half_axes) {
  std::vector<LoftRing> rings;
  add_cap(rings, 0, 1, -1);
  rings.pop_back();  // the equator belongs to both hemispheres
  add_cap(rings, 0, 1, 1);
  for (LoftRing& ring : rings)
    ring = {half_axes.cwiseProduct(ring.centre), half_axes.x() * ring.half_x, half_axes.y() * ring.half_y};
  return make_loft(rings);
}

TriangleMesh make_limb(double length, double radius, double end_radius) {
  std::vector<LoftRing> rings;
  add_cap(rings, 0, radius, -1);
  add_cap(rings, length, end_radius, 1);
  return make_loft(rings);
}

SE3 limb_between(const Vector3d& begin, const Vector3d& end) {
  return {Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), end - begin).toRotationMatrix(), begin};
}

}  // namespace barehand::synthetic
