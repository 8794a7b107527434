// Extracts a closed mesh of an object from samples of its visible surface.
#include "stages/contact/scanned_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hand/surface_nets.h"
#include "math/disjoint_sets.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr float kSearchCell = 0.004f;  // cell size of the grid in which samples are searched [m]
constexpr int kSearchReach = 2;        // cells to each side in which samples are searched
constexpr float kRadius = 0.008f;      // samples nearer to each other than this share the surface around them [m]
constexpr float kSmooth = 0.005f;      // width of the Gaussian weights of the samples' tangent planes [m]
constexpr float kSameSide = 0.3f;      // least cosine between the normals of samples on one side of a sheet
// Distances from the nearest sample [m]: up to kNear, the samples' tangent planes alone give the signed distance; from
// kFar on, the winding number alone.
constexpr float kNear = 0.004f, kFar = 0.008f;
constexpr double kMargin = 0.01;  // margin around the samples [m]
constexpr float kCore = 0.003f;   // smallest distance in the winding number [m]

/// The signed distance from the surface of an object of which samples are known; negative inside.
class SampledSolid {
 public:
  explicit SampledSolid(std::span<const SurfaceSample> samples);
  /// Signed distance near the samples; elsewhere a value with the right sign [m].
  double distance(const Vector3d& place) const;
  /// Distance to the nearest sample [m], if it is smaller than kFar; otherwise infinity.
  float apart(const Vector3f& p) const { return at(p).apart; }
  const Vector3f& lower() const { return lower_; }
  const Vector3f& upper() const { return upper_; }

 private:
  /// Distances of a point from the samples around it [m].
  struct Nearby {
    float apart = std::numeric_limits<float>::infinity();  // distance to the nearest sample
    float height = 0;  // weighted mean of the signed distances from their tangent planes
  };

  template <class Act>
  void for_nearby(const Vector3f& p, const Act& act) const;
  Nearby at(const Vector3f& p) const;
  float winding_number(const Vector3f& p) const;
  void measure_areas();
  Vector3i indices(const Vector3f& p) const { return ((p - origin_) / kSearchCell).array().floor().cast<int>(); }
  std::size_t number(const Vector3i& i) const {
    return (static_cast<std::size_t>(i.z()) * static_cast<std::size_t>(side_.y()) + static_cast<std::size_t>(i.y())) *
               static_cast<std::size_t>(side_.x()) +
           static_cast<std::size_t>(i.x());
  }

  std::vector<SurfaceSample> samples_;  // sorted by their cells
  std::vector<std::size_t> first_;      // index of each cell's first sample, and the end
  Eigen::ArrayX3f places_, fluxes_;     // positions of the samples; their normals times area over 4 pi
  Vector3f lower_, upper_, origin_;
  Vector3i side_;
};

SampledSolid::SampledSolid(std::span<const SurfaceSample> samples) {
  // Enclose the samples in a grid.
  lower_ = upper_ = samples[0].p;
  for (const SurfaceSample& sample : samples) lower_ = lower_.cwiseMin(sample.p), upper_ = upper_.cwiseMax(sample.p);
  origin_ = lower_;
  side_ = ((upper_ - lower_) / kSearchCell).array().floor().cast<int>() + 1;

  // Sort the samples into the cells of the grid.
  first_.assign(static_cast<std::size_t>(side_.cast<long>().prod()) + 1, 0);
  for (const SurfaceSample& sample : samples) ++first_[number(indices(sample.p)) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  samples_.resize(samples.size());
  std::vector<std::size_t> next = first_;
  for (const SurfaceSample& sample : samples) samples_[next[number(indices(sample.p))]++] = sample;
  measure_areas();
}

/// Calls `act` with the samples in the cells around a place.
template <class Act>
void SampledSolid::for_nearby(const Vector3f& p, const Act& act) const {
  const Vector3i i = indices(p);
  const Vector3i low = (i.array() - kSearchReach).max(0), high = (i.array() + kSearchReach).min(side_.array() - 1);
  if ((low.array() > high.array()).any()) return;
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y) {
      const std::size_t end = first_[number({high.x(), y, z}) + 1];
      for (std::size_t k = first_[number({low.x(), y, z})]; k < end; ++k) act(samples_[k]);
    }
}

/// Computes the area of each sample: nearby samples share the surface. The area is limited, since a sample at a border
/// has few neighbours and would get too much.
void SampledSolid::measure_areas() {
  const auto count = static_cast<Eigen::Index>(samples_.size());
  places_.resize(count, 3);
  fluxes_.resize(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SurfaceSample& own = samples_[static_cast<std::size_t>(k)];

    // Count the nearby samples of the same side, which share the area around this one.
    int sharing = 0;
    for_nearby(own.p, [&](const SurfaceSample& other) {
      sharing += (other.p - own.p).squaredNorm() < kRadius * kRadius && other.n.dot(own.n) > kSameSide;
    });
    constexpr float kPi = std::numbers::pi_v<float>;
    const float area = std::min(kPi * kRadius * kRadius / static_cast<float>(sharing), kSearchCell * kSearchCell);
    places_.row(k) = own.p.transpose();
    fluxes_.row(k) = area / (4 * kPi) * own.n.transpose();
  }
}

SampledSolid::Nearby SampledSolid::at(const Vector3f& p) const {
  // Find the nearest sample.
  const SurfaceSample* nearest = nullptr;
  float least = kFar * kFar;
  for_nearby(p, [&](const SurfaceSample& sample) {
    const float distance = (sample.p - p).squaredNorm();
    if (distance < least) least = distance, nearest = &sample;
  });
  if (!nearest) return {};

  // Average the signed distances from the tangent planes of samples on the same side of the object as the nearest one.
  float sum = 0, height = 0;
  for_nearby(p, [&](const SurfaceSample& sample) {
    if (sample.n.dot(nearest->n) < kSameSide) return;
    const float weight = std::exp(-((sample.p - p).squaredNorm() - least) / (kSmooth * kSmooth));
    sum += weight;
    height += weight * sample.n.dot(p - sample.p);
  });
  return {std::sqrt(least), height / sum};
}

float SampledSolid::winding_number(const Vector3f& p) const {
  const Eigen::ArrayX3f d = places_.rowwise() - p.transpose().array();
  const Eigen::ArrayXf distance_sq = d.square().rowwise().sum().max(kCore * kCore);
  return ((d * fluxes_).rowwise().sum() / (distance_sq * distance_sq.sqrt())).sum();
}

double SampledSolid::distance(const Vector3d& place) const {
  const Vector3f p = place.cast<float>();
  const Nearby nearby = at(p);
  if (nearby.apart <= kNear) return nearby.height;
  const float far = 2 * kFar * (0.5f - winding_number(p));
  if (!std::isfinite(nearby.apart)) return far;
  const float share = (nearby.apart - kNear) / (kFar - kNear);
  return share * far + (1 - share) * nearby.height;
}

/// The connected part of a mesh with the most triangles.
ObjectMesh largest_part(const TriangleMesh& mesh) {
  // Join the vertices of each triangle.
  DisjointSets parts;
  while (parts.size() < mesh.vertices.size()) parts.add();
  for (const auto& t : mesh.triangles) parts.join(parts.join(t[0], t[1]), t[2]);

  // Find the part with the most triangles.
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles) ++count[parts.root(t[0])];
  const int best = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());

  // Copy the vertices of this part.
  ObjectMesh part;
  std::vector<std::uint32_t> index(mesh.vertices.size());
  for (int i = 0; i < static_cast<int>(mesh.vertices.size()); ++i) {
    if (parts.root(i) != best) continue;
    index[i] = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.push_back(mesh.vertices[i].cast<float>());
  }

  // Copy its triangles with the new numbers of their corners.
  for (const auto& t : mesh.triangles)
    if (parts.root(t[0]) == best) part.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  return part;
}

}  // namespace

ScannedMesh scanned_mesh(std::span<const SurfaceSample> samples, double cell) {
  if (samples.size() < kFewestSamples) return {};

  // Extract the surface.
  const SampledSolid solid(samples);
  const TriangleMesh surface = extract_surface([&](const Vector3d& p) { return solid.distance(p); },
                                               solid.lower().cast<double>().array() - kMargin,
                                               solid.upper().cast<double>().array() + kMargin, cell);
  if (surface.triangles.empty()) return {};
  ScannedMesh scanned{largest_part(surface), 0, 0};

  // Separate the triangles that were seen from those that close the surface.
  const auto& v = scanned.mesh.vertices;
  auto& triangles = scanned.mesh.triangles;
  const auto lids = std::ranges::stable_partition(triangles, [&](const MeshDistance::Triangle& t) {
    return solid.apart((v[t[0]] + v[t[1]] + v[t[2]]) / 3) < kNear;
  });
  scanned.lids = triangles.size() - lids.size();

  // Compare their areas.
  double seen = 0, all = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const double area = (v[b] - v[a]).cross(v[c] - v[a]).norm();
    all += area;
    if (i < scanned.lids) seen += area;
  }
  scanned.seen = seen / all;
  return scanned;
}

}  // namespace barehand
