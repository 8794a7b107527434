#include "stages/contact/surface_distance.h"

#include <algorithm>
#include <cmath>

#include "math/fast_math.h"

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr float kBandwidth = 0.006f;  // h: distance over which planes are averaged [m]
// The surface is known where one of its points is within kAside to the side. Skin that is farther inside than kBehind
// is behind a surface whose far side is unknown [m].
constexpr float kAside = 0.004f, kBehind = 0.006f;
constexpr float kInside = 0.001f;      // how far skin enters a surface at most [m]
constexpr float kTestedStep = 0.002f;  // distance from one tested place to the next along an unseen surface [m]
constexpr float kDepth = 0.03f;        // how far an object may continue along the ray behind its edge [m]
// The curvature of a surface where nothing is known of it [1/m], the deviation of a single normal over that of the
// curvature, squared [m^2], the largest accepted curvature [1/m], and the distance over which it is measured [m].
constexpr float kUsualBend = 1 / 0.038f, kPrior = 4e-5f, kMostBend = 60, kPlaneRadius = 0.012f;
constexpr float kSpread = 0.25f;  // error of an unseen surface, as a fraction of its distance from the visible surface

}  // namespace

std::optional<NearestSurface> SurfaceDistance::measure(const PosedSkin& skin, std::span<const SurfacePoint> surface,
                                                       const SeenEmpty& empty) {
  // Collect the points near the segment.
  close_.clear();
  x_.clear(), y_.clear(), z_.clear();
  const float reach = skin.radius + kReach;
  for (const SurfacePoint& point : surface)
    if ((point.p - skin.centre).squaredNorm() < reach * reach) {
      close_.push_back(point);
      x_.push_back(point.p.x()), y_.push_back(point.p.y()), z_.push_back(point.p.z());
    }
  if (close_.empty()) return std::nullopt;
  distance_sq_.resize(close_.size());

  // Find the nearest place.
  std::optional<NearestSurface> nearest;
  for (const Vector3f& x : skin.points) {
    Plane plane;
    if (!find_plane(x, plane)) continue;

    // If the nearest point lies to the side, extend the surface towards the skin.
    const float height = plane.height, aside_sq = plane.apart * plane.apart - height * height;
    if (aside_sq >= kAside * kAside) {
      if (nearest && std::max(height, 0.f) >= nearest->distance) continue;
      const NearestSurface unseen = extend(x, plane, empty);
      if (!nearest || unseen.distance < nearest->distance) nearest = unseen;
      continue;
    }

    // Otherwise the surface is seen at this place. Skin that seems to be inside touches it, or is behind something
    // thin.
    if (height < -kBehind) continue;
    const float distance = std::max(height, -kInside);
    if (!nearest || distance < nearest->distance)
      nearest = {distance, distance - height, x - height * plane.normal, plane.normal, plane.nearest->object};
  }
  return nearest;
}

/// Finds the known point nearest to x, and averages the planes around it. False: there is none within kReach.
bool SurfaceDistance::find_plane(const Vector3f& x, Plane& plane) {
  // Find the nearest point of the surface.
  const float px = x.x(), py = x.y(), pz = x.z();
  for (std::size_t i = 0; i < close_.size(); ++i) {
    const float dx = px - x_[i], dy = py - y_[i], dz = pz - z_[i];
    distance_sq_[i] = dx * dx + dy * dy + dz * dz;
  }
  const auto best =
      static_cast<std::size_t>(std::min_element(distance_sq_.begin(), distance_sq_.end()) - distance_sq_.begin());

  // Leave out skin that is too far from the surface.
  const float least_sq = distance_sq_[best];
  if (least_sq > kReach * kReach) return false;

  // Average the planes of the points around it.
  float weights = 0, f = 0;
  Vector3f normal = Vector3f::Zero();
  for (std::size_t i = 0; i < close_.size(); ++i) {
    if (distance_sq_[i] > least_sq + 7 * kBandwidth * kBandwidth) continue;  // its weight is negligible
    const float w = fast_exp((least_sq - distance_sq_[i]) / (kBandwidth * kBandwidth));
    weights += w;
    f += w * close_[i].n.dot(x - close_[i].p);
    normal += w * close_[i].n;
  }

  // Normals that cancel each other define no plane.
  if (normal.squaredNorm() < 1e-6f) return false;
  plane = {&close_[best], std::sqrt(least_sq), f / weights, normal.normalized()};
  return true;
}

/// The distance of x from a surface that is only seen some way to the side.
NearestSurface SurfaceDistance::extend(const Vector3f& x, const Plane& plane, const SeenEmpty& empty) const {
  // Walk towards the foot of x until a place is seen to be empty.
  const Vector3f& p = plane.nearest->p;
  float least = std::max(plane.height, 0.f), most = least;
  const Vector3f foot = x - least * plane.normal, way = foot - p;
  const float length = way.norm();
  const int steps = 1 + static_cast<int>(length / kTestedStep);

  // Remember the last place that is not seen to be empty.
  Vector3f end = p;
  for (int k = 1; k <= steps; ++k) {
    const Vector3f at = p + way * (static_cast<float>(k) / static_cast<float>(steps));
    if (!empty(plane.nearest->object, at)) {
      end = at;
      continue;
    }

    // The object ends here, or continues along the ray behind this place.
    const Vector3f ray = end.normalized();
    const float behind = std::clamp((x - end).dot(ray), 0.f, kDepth);
    most = (x - end).norm();
    least = std::min(most, (x - end - behind * ray).norm());
    break;
  }

  // The surface curves away from its plane, but its nearest known point is certain.
  const float unseen = (end - p).norm(),
              sag = 0.5f * bend(*plane.nearest, way / std::max(length, 1e-6f)) * unseen * unseen;
  const float distance = std::min(0.5f * (least + most) + sag, plane.apart);
  const float deviation = std::min(kSpread * unseen + 0.5f * (most - least), plane.apart);
  return {distance, deviation, end - std::min(sag, plane.apart) * plane.normal, plane.normal, plane.nearest->object};
}

/// Curvature of the surface around a point along a direction [1/m]: the slope of its normals.
float SurfaceDistance::bend(const SurfacePoint& p, const Vector3f& direction) const {
  float count = 0, s = 0, n = 0, ss = 0, sn = 0;
  for (const SurfacePoint& point : close_) {
    const Vector3f d = point.p - p.p;
    if (d.squaredNorm() > kPlaneRadius * kPlaneRadius || point.object != p.object) continue;
    const float along = d.dot(direction), turn = point.n.dot(direction);
    count += 1, s += along, n += turn, ss += along * along, sn += along * turn;
  }
  const float variance = ss - s * s / count, covariance = sn - s * n / count;
  return std::clamp((covariance + kPrior * kUsualBend) / (variance + kPrior), 0.f, kMostBend);
}

}  // namespace barehand
