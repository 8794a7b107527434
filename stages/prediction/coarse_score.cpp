#include "stages/prediction/coarse_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/random.h"

namespace barehand {

namespace {

constexpr float kCloseToHand = 0.008f;  // [m] holes and missing borders this close to the hand may be hand
constexpr float kFootprint = 0.4f;      // half side of a splat in point widths; 0.5 would fatten the silhouette

}  // namespace

CoarseSkin make_coarse_skin(const HandSurface& surface, double spacing) {
  CoarseSkin coarse;
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentSurface& skin = surface[s];
    double area = 0;
    for (const float a : skin.area) area += a;
    const double wanted = std::ceil(area / (spacing * spacing));
    const auto count = std::min(skin.size(), static_cast<std::size_t>(wanted));
    // Jitter within equal strata: a fixed stride would beat against the spiral in which surfaces are sampled.
    KeyedRandom random(0, static_cast<std::uint32_t>(s));
    for (std::size_t k = 0; k < count; ++k) {
      const auto i = std::min(skin.size() - 1,
                              static_cast<std::size_t>((static_cast<double>(k) + random.uniform()) *
                                                       static_cast<double>(skin.size()) / static_cast<double>(count)));
      coarse.points[s].push_back({{skin.x[i], skin.y[i], skin.z[i]},
                                  {skin.nx[i], skin.ny[i], skin.nz[i]},
                                  static_cast<float>(std::sqrt(area / static_cast<double>(count)))});
    }
  }
  return coarse;
}

CoarseScorer::CoarseScorer(const CoarseGrid& grid, const CoarseSkin& skin, const CoarseScoreParams& params)
    : grid_(grid), skin_(skin), params_(params), z_(grid.depth.size(), 0), stamp_(grid.depth.size(), 0) {
  covered_.reserve(grid.depth.size());
}

double CoarseScorer::operator()(const HandPose& pose) {
  for (const SE3& T : pose) {
    if (!T.all_finite()) return std::numeric_limits<double>::infinity();
  }
  if (grid_.empty()) return std::numeric_limits<double>::infinity();
  splat(pose);
  double cost = outside_cost_;
  int explained = 0;
  for (const std::int32_t i : covered_) {
    cost += cell_cost(i, z_[i]);
    explained += grid_.label[i] == PixelLabel::hand;
  }
  cost += params_.unexplained * (grid_.hand_cells - explained);
  return cost / grid_.hand_cells;
}

double CoarseScorer::cell_cost(std::size_t i, float z) const {
  const float cap = static_cast<float>(params_.depth_cap);
  const float data = grid_.depth[i];
  const float distance = std::min(grid_.hand_distance[i], cap) / cap;
  switch (grid_.label[i]) {
    case PixelLabel::hand:
      return std::min(std::abs(z - data), cap) / cap;
    case PixelLabel::unknown:
      return grid_.hand_distance[i] < kCloseToHand ? 0.1 : params_.unknown * distance;
    case PixelLabel::object:
      if (data > 0 && data < z) return params_.hidden;
      break;
    case PixelLabel::background:
      break;
  }
  return params_.background * distance;
}

void CoarseScorer::splat(const HandPose& pose) {
  ++now_;
  covered_.clear();
  outside_cost_ = 0;
  for (int s = 0; s < kSegmentCount; ++s) {
    const Eigen::Matrix3f R = pose[s].R.cast<float>();
    const Eigen::Vector3f t = pose[s].t.cast<float>();
    for (const CoarseSkin::Point& q : skin_.points[s]) {
      const Eigen::Vector3f p = R * q.p + t;
      if (p.z() > 0.02f && (R * q.n).dot(p) < 0) splat_point(p.x(), p.y(), p.z(), q.width);
    }
  }
}

void CoarseScorer::splat_point(float x, float y, float z, float width) {
  const Intrinsics& c = grid_.camera;
  const float u = static_cast<float>(c.fx) * x / z + static_cast<float>(c.cx);
  const float v = static_cast<float>(c.fy) * y / z + static_cast<float>(c.cy);
  const float half = kFootprint * static_cast<float>(c.fx) * width / z;
  const int i_lo = static_cast<int>(std::floor(u - half + 0.5f)), i_hi = static_cast<int>(std::floor(u + half + 0.5f));
  const int j_lo = static_cast<int>(std::floor(v - half + 0.5f)), j_hi = static_cast<int>(std::floor(v + half + 0.5f));
  if (i_lo < 0 || j_lo < 0 || i_hi >= grid_.depth.width() || j_hi >= grid_.depth.height()) {
    const int i = static_cast<int>(std::lround(u)), j = static_cast<int>(std::lround(v));
    if (!grid_.depth.contains(i, j)) {
      // Beyond the region of interest, yet in the image, no hand was found.
      outside_cost_ += grid_.in_image(i, j) ? params_.background : params_.outside;
      return;
    }
  }
  for (int j = std::max(0, j_lo); j <= std::min(j_hi, grid_.depth.height() - 1); ++j) {
    for (int i = std::max(0, i_lo); i <= std::min(i_hi, grid_.depth.width() - 1); ++i) {
      const std::size_t index = grid_.depth.index(i, j);
      if (stamp_[index] != now_) {
        stamp_[index] = now_;
        z_[index] = z;
        covered_.push_back(static_cast<std::int32_t>(index));
      } else {
        z_[index] = std::min(z_[index], z);
      }
    }
  }
}

}  // namespace barehand
