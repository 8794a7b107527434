#include "observe/sampled/pixel_map.h"

#include <algorithm>
#include <limits>

namespace barehand {
namespace {

// Computes the look-up table of the local trackers from an observation.

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr PixelMap::Cell kSilent{0, 0, -1, -kInfinity};  // a cell that gives no evidence

/// Computes the cells of a PixelMap from one observation.
class Cells {
 public:
  Cells(const HandObservation& observation, const PixelRays& rays, bool missing_is_background)
      : o_(observation), rays_(rays), missing_is_background_(missing_is_background) {}

  // The cell of a pixel (u, v) within the region of interest.
  PixelMap::Cell at(int u, int v) const {
    const std::size_t pixel = o_.label.index(u, v);
    const float z = o_.depth[pixel];
    if (o_.label[pixel] == PixelLabel::hand) {
      const Eigen::Vector3f p = rays_.point(u, v, z);
      return {p.x(), p.y(), p.z(), kInfinity};
    }
    if (o_.label[pixel] == PixelLabel::unknown && !missing_is_background_) return kSilent;
    // Any depth that is not skin hides what lies behind it.
    return not_hand(pixel, z > 0 ? z : kInfinity);
  }

  // The cell of a pixel that is not hand and hides what is behind `occluder_z` [m].
  PixelMap::Cell not_hand(std::size_t pixel, float occluder_z) const {
    const std::int32_t nearest = o_.nearest_hand[pixel];
    if (nearest < 0) return kSilent;  // no hand pixel anywhere: the paper's Eq. 1 is undefined
    const Eigen::Vector3f p = rays_.point(nearest, o_.depth);
    return {p.x(), p.y(), -p.z(), occluder_z};
  }

 private:
  const HandObservation& o_;
  const PixelRays& rays_;
  const bool missing_is_background_;
};

}  // namespace

PixelMap make_pixel_map(const HandObservation& o, bool missing_is_background, Workers& workers, PixelMap reused) {
  // The map is one pixel larger on each side than the region of interest.
  const Intrinsics& camera = o.frame->camera;
  const int w = o.label.width(), h = o.label.height();

  // Reuse the memory of the previous map.
  PixelMap map = std::move(reused);
  map.width = w + 2;
  map.height = h + 2;

  // Camera parameters in the coordinates of the map.
  map.fx = static_cast<float>(camera.fx);
  map.fy = static_cast<float>(camera.fy);
  map.cx = static_cast<float>(camera.cx - o.u0 + 1);
  map.cy = static_cast<float>(camera.cy - o.v0 + 1);

  // Without a region of interest no pixel gives evidence.
  map.cells.assign(static_cast<std::size_t>(map.width) * map.height, kSilent);
  map.hidden.assign(map.cells.size(), 0);
  if (w == 0 || h == 0) return map;

  // Fill the map row by row.
  map.rays.reset(camera, o.u0, o.v0, w, h);
  const Cells cells(o, map.rays, missing_is_background);
  workers.for_each_index(map.height, [&](int row) {
    const int v = row - 1;
    for (int u = -1; u <= w; ++u) {
      // Inside the region each pixel has its own label; between the region and the image's border it is not hand;
      // outside the image it gives no evidence.
      PixelMap::Cell& cell = map.cells[map.index(u + 1, row)];
      if (o.label.contains(u, v)) {
        cell = cells.at(u, v);
      } else if (u + o.u0 >= 0 && u + o.u0 < camera.width && v + o.v0 >= 0 && v + o.v0 < camera.height) {
        cell = cells.not_hand(o.label.index(std::clamp(u, 0, w - 1), std::clamp(v, 0, h - 1)), kInfinity);
      }
    }
  });
  return map;
}

}  // namespace barehand
