#include "stages/contact/observed_space.h"

namespace barehand {
namespace {

// Half the thickness of a surface: a constant part [m], and a multiple of the sensor's standard deviation.
constexpr double kEmptyMargin = 0.003, kDeviations = 2;
constexpr int kHoleRadius = 2;  // neighbours on each side of a pixel without depth that must have no depth either [px]

}  // namespace

void ObservedSpace::observe(const HandObservations& observations) {
  views_.clear();
  for (const HandObservationPtr& observation : observations) {
    if (!observation->hand_present || observation->depth.empty()) continue;
    const Intrinsics& camera = observation->frame->camera;
    views_.push_back({observation.get(), static_cast<float>(camera.fx), static_cast<float>(camera.fy),
                      static_cast<float>(camera.cx - observation->u0), static_cast<float>(camera.cy - observation->v0),
                      static_cast<float>(kEmptyMargin + kDeviations * observation->noise)});
  }
}

ObservedSpace::Occupancy ObservedSpace::at(const Eigen::Vector3f& p) const {
  if (p.z() <= 0) return Occupancy::unknown;
  for (const View& view : views_) {
    const auto [u, v] = view.pixel_of(p);
    const Image<float>& depth = view.observation->depth;
    if (!depth.contains(u, v) || depth.at(u, v) <= 0) continue;
    const float behind = depth.at(u, v) - p.z();
    if (behind > view.margin) return Occupancy::empty;
    if (behind > -view.margin) return Occupancy::surface;
  }
  return Occupancy::unknown;
}

bool ObservedSpace::blank(const Eigen::Vector3f& p) const {
  if (p.z() <= 0) return false;
  bool in_view = false;
  for (const View& view : views_) {
    const auto [u, v] = view.pixel_of(p);
    const Image<float>& depth = view.observation->depth;
    if (!depth.contains(u - kHoleRadius, v - kHoleRadius) || !depth.contains(u + kHoleRadius, v + kHoleRadius))
      continue;

    // Look for a measured depth around the pixel.
    in_view = true;
    for (int y = v - kHoleRadius; y <= v + kHoleRadius; ++y)
      for (int x = u - kHoleRadius; x <= u + kHoleRadius; ++x)
        if (depth.at(x, y) > 0) return false;
  }
  return in_view;
}

}  // namespace barehand
