#include "object/known_object.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "math/random.h"
#include "object/half_turns.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kSamples = 1000;
// Size of the grid's cells as a fraction of the object, and its bounds [m].
constexpr double kCells = 1.0 / 60, kFinest = 0.0015, kCoarsest = 0.005;
// About a round axis a quarter turn moves more than kLeastMoved and at most kMostMoved of the surface by kMoved [m].
constexpr double kMoved = 0.008, kLeastMoved = 0.02, kMostMoved = 0.3;
constexpr int kTurns = 12;

/// The turns of KnownObject::turns.
std::vector<SE3> turns_of_little_change(const ObjectMesh& mesh, const DistanceGrid& grid,
                                        std::span<const SurfaceSample> samples) {
  std::vector<SE3> turns;
  for (const SE3& half : half_turns(mesh)) {
    const Vector3d axis = log_so3(half.R).normalized(), middle = 0.5 * half.t;
    const auto turned = [&](double angle) -> SE3 {
      const Eigen::Matrix3d R = exp_so3(angle * axis);
      return {R, middle - R * middle};
    };

    const double share = moved_share(grid, samples, turned(std::numbers::pi / 2), kMoved);
    if (share < kLeastMoved || share > kMostMoved) {
      turns.push_back(half);
      continue;
    }
    for (int k = 1; k < kTurns; ++k) turns.push_back(turned(2 * std::numbers::pi * k / kTurns));
  }
  return turns;
}

}  // namespace

double moved_share(const DistanceGrid& grid, std::span<const SurfaceSample> samples, const SE3& T_object_object,
                   double distance) {
  const Eigen::Matrix3f R = T_object_object.R.cast<float>();
  const Vector3f t = T_object_object.t.cast<float>();
  const auto moved = std::ranges::count_if(
      samples, [&](const SurfaceSample& sample) { return std::abs(grid.distance(R * sample.p + t)) > distance; });
  return static_cast<double>(moved) / static_cast<double>(samples.size());
}

std::vector<SurfaceSample> sample_surface(const ObjectMesh& mesh) {
  // Add up the areas.
  std::vector<double> upto;
  double area = 0;
  const auto corner = [&](std::size_t t, int k) -> const Vector3f& { return mesh.vertices[mesh.triangles[t][k]]; };
  const auto cross = [&](std::size_t t) -> Vector3f {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) upto.push_back(area += 0.5 * cross(t).norm());

  // Draw one place from every equal share of the area.
  KeyedRandom random(0, 0);
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < kSamples; ++i) {
    const double at = area * (i + random.uniform()) / kSamples;
    const auto found = std::min(std::upper_bound(upto.begin(), upto.end(), at), upto.end() - 1);
    const auto t = static_cast<std::size_t>(found - upto.begin());

    // Draw a place that is uniformly distributed over the triangle.
    const auto u = static_cast<float>(std::sqrt(random.uniform())), v = static_cast<float>(random.uniform());
    samples.push_back(
        {(1 - u) * corner(t, 0) + u * (1 - v) * corner(t, 1) + u * v * corner(t, 2), cross(t).normalized()});
  }

  // Shuffle them, so that the first few are spread evenly, too.
  for (std::size_t i = samples.size() - 1; i > 0; --i) std::swap(samples[i], samples[random.bits() % (i + 1)]);
  return samples;
}

KnownObjectPtr make_known_object(const ObjectMesh& mesh, std::int32_t id) {
  // Measure the mesh.
  const Eigen::AlignedBox3f box = bounding_box(mesh);
  const Vector3f lower = box.min(), upper = box.max();
  const Vector3d extent = (upper - lower).cast<double>(), centre = 0.5 * (lower + upper).cast<double>();
  double radius = 0;
  for (const Vector3f& v : mesh.vertices) radius = std::max(radius, (v.cast<double>() - centre).norm());

  // Sample distances and surface.
  const double cell = std::clamp(kCells * extent.maxCoeff(), kFinest, kCoarsest);
  const MeshDistance distance(mesh.vertices, mesh.triangles);
  DistanceGrid grid(distance, lower.cast<double>(), upper.cast<double>(), cell);
  std::vector<SurfaceSample> samples = sample_surface(mesh);

  // Leave out the samples of one part of the object that lie inside another part.
  std::erase_if(samples, [&](const SurfaceSample& sample) { return grid.distance(sample.p) < -cell; });
  std::vector<SE3> turns = turns_of_little_change(mesh, grid, samples);
  return std::make_shared<KnownObject>(
      KnownObject{mesh.name, id, std::move(grid), std::move(samples), centre, extent, radius, std::move(turns)});
}

}  // namespace barehand
