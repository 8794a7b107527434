#include "stages/contact/surface_distance.h"

#include <cmath>

#include "math/fast_math.h"

namespace barehand {
namespace {

constexpr float kBandwidth = 0.006f;  // h: distance over which planes are averaged [m]
// The surface is known where a point of it is no farther aside than this. Skin that is farther inside than kBehind is
// behind a surface whose far side is unknown [m].
constexpr float kAside = 0.004f, kBehind = 0.006f;
constexpr float kEnd = 0.2f;  // how soon a surface ends where it is not seen: 0 never, 1 at once

}  // namespace

std::optional<NearestSurface> SurfaceDistance::measure(const PosedSkin& skin, std::span<const SurfacePoint> surface) {
  // Collect the points near the segment.
  close_.clear();
  const float reach = skin.radius + kReach;
  for (const SurfacePoint& point : surface)
    if ((point.p - skin.centre).squaredNorm() < reach * reach) close_.push_back(&point);
  if (close_.empty()) return std::nullopt;
  distance_sq_.resize(close_.size());

  std::optional<NearestSurface> nearest;
  for (const Eigen::Vector3f& x : skin.points) {
    // Find the nearest known point.
    std::size_t best = 0;
    for (std::size_t i = 0; i < close_.size(); ++i) {
      distance_sq_[i] = (x - close_[i]->p).squaredNorm();
      if (distance_sq_[i] < distance_sq_[best]) best = i;
    }
    const float least_sq = distance_sq_[best], least = std::sqrt(least_sq);
    if (least > kReach) continue;

    // Average the planes around it.
    float weights = 0, f = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < close_.size(); ++i) {
      const float w = fast_exp((least_sq - distance_sq_[i]) / (kBandwidth * kBandwidth));
      if (w < 1e-3f) continue;
      weights += w;
      f += w * close_[i]->n.dot(x - close_[i]->p);
      normal += w * close_[i]->n;
    }
    f /= weights;
    if (normal.squaredNorm() < 1e-6f) continue;
    const bool known = least_sq - f * f < kAside * kAside;
    if (known && f < -kBehind) continue;

    // The surface goes on as that plane, as far as the skin leaves room for it, or ends.
    const float plane = known ? f : std::max(f, 0.f), open = std::max(0.f, least - std::abs(plane));
    const float distance = plane + kEnd * open;
    if (nearest && distance >= nearest->distance) continue;
    normal.normalize();
    nearest = NearestSurface{distance, kEnd * open, x - f * normal, normal, close_[best]->object};
  }
  return nearest;
}

}  // namespace barehand
