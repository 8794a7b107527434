// An index of the observed points for nearest-neighbour queries.
#include "observe/registration/observed_cloud.h"

#include <cassert>
#include <cmath>
#include <nanoflann.hpp>

namespace barehand {

struct ObservedCloud::Index {
  std::vector<Eigen::Vector3f> points, normals;

  // nanoflann's data set interface.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Index>, Index, 3>;
  Tree tree{3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(16)};
};

namespace {

struct Pixel {
  int u, v;
};
/// The pixel of the region of interest onto which the point `p` projects; it may be outside the region. `p` must have z
/// > 0.
Pixel pixel_of(const HandObservation& observation, const Eigen::Vector3d& p) {
  const Eigen::Vector2d uv = observation.frame->camera.project(p);
  return {static_cast<int>(std::lround(uv.x())) - observation.u0,
          static_cast<int>(std::lround(uv.y())) - observation.v0};
}

/// Normal of the pixel in which the point lies; a measured normal always faces the camera.
Eigen::Vector3f normal_at(const HandObservation& observation, const Eigen::Vector3f& p) {
  const auto [u, v] = pixel_of(observation, p.cast<double>());
  return observation.normal.contains(u, v) ? observation.normal.at(u, v) : Eigen::Vector3f::Zero();
}

}  // namespace

ObservedCloud::ObservedCloud() : index_(std::make_unique<Index>()) {}
ObservedCloud::ObservedCloud(const HandObservation& observation) : ObservedCloud() { reset(observation); }

void ObservedCloud::reset(const HandObservation& observation) {
  observation_ = &observation;
  index_->points = observation.cloud;
  std::erase_if(index_->points, [](const Eigen::Vector3f& p) { return !(p.z() > 0) || !p.allFinite(); });
  index_->normals.clear();
  for (const Eigen::Vector3f& p : index_->points) index_->normals.push_back(normal_at(observation, p));
  index_->tree.buildIndex();
}

ObservedCloud::~ObservedCloud() = default;
ObservedCloud::ObservedCloud(ObservedCloud&&) noexcept = default;
ObservedCloud& ObservedCloud::operator=(ObservedCloud&&) noexcept = default;

std::size_t ObservedCloud::size() const { return index_->points.size(); }
Eigen::Vector3d ObservedCloud::point(std::size_t i) const { return index_->points[i].cast<double>(); }
Eigen::Vector3d ObservedCloud::normal(std::size_t i) const { return index_->normals[i].cast<double>(); }

Eigen::Vector3d ObservedCloud::centroid() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : index_->points) sum += p.cast<double>();
  return sum / static_cast<double>(std::max<std::size_t>(1, size()));
}

std::size_t ObservedCloud::nearest(const Eigen::Vector3d& p, std::size_t guess) const {
  assert(guess < size());
  const Eigen::Vector3f query = p.cast<float>();
  std::size_t best = 0;
  float distance_sq = 0;
  nanoflann::KNNResultSet<float> result(1);
  result.init(&best, &distance_sq);
  result.addPoint((index_->points[guess] - query).squaredNorm(), guess);  // limits the search to nearer points
  index_->tree.findNeighbors(result, query.data(), nanoflann::SearchParams());
  return best;
}

bool ObservedCloud::hidden(const Eigen::Vector3d& p) const {
  if (!(p.z() > 0)) return false;
  const auto [u, v] = pixel_of(*observation_, p);
  if (!observation_->label.contains(u, v) || observation_->label.at(u, v) != PixelLabel::object) return false;
  const float z = observation_->depth.at(u, v);
  return z > 0 && z < p.z();
}

}  // namespace barehand
