#include "stages/known_object/observed_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kSlant = 0.2;       // cosine of the angle at which a surface is still measured
constexpr double kAlike = 0.006;     // difference in depth of the same surface, besides noise [m]
constexpr double kEdge = 0.007;      // difference in depth of neighbouring pixels on different surfaces [m]
constexpr double kAveraged = 0.010;  // difference in depth of neighbouring pixels up to which they are averaged [m]
// Directions in which an outline is looked at, and how far beyond the last visible place [m].
constexpr std::size_t kDirections = 32;
constexpr double kNearBeyond = 0.008, kFarBeyond = 0.014;
constexpr double kInPlane = 0.005;  // distance in depth from a plane that is continued, besides noise [m]
constexpr float kLeave = 0.004f, kInside = 0.0005f;

/// Whether the object itself is between a place on its surface and the camera. Follows the ray in steps of the distance
/// to the surface.
bool hides_itself(const KnownObject& object, const Vector3f& place, const Vector3f& to_camera) {
  const Vector3f centre = object.centre.cast<float>();
  const auto radius = static_cast<float>(object.radius);
  for (float along = kLeave; along < 2 * radius;) {
    const Vector3f p = place + along * to_camera;
    if ((p - centre).squaredNorm() > radius * radius) return false;
    const float distance = object.grid.distance(p);
    if (distance < kInside) return true;
    along += std::max(distance, 0.001f);
  }
  return false;
}

/// Unit vectors in the image plane, evenly spread.
std::array<Eigen::Vector2d, kDirections> directions_around() {
  std::array<Eigen::Vector2d, kDirections> directions;
  for (std::size_t k = 0; k < kDirections; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kDirections;
    directions[k] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

}  // namespace

ObservedDepth::ObservedDepth(HandObservations observations)
    : observations_(std::move(observations)), frame_(observations_.front()->frame.get()) {
  for (const auto& observation : observations_) noise_ = std::max(noise_, observation->noise);
}

bool ObservedDepth::of_hand(int u, int v) const {
  return std::any_of(observations_.begin(), observations_.end(), [&](const HandObservationPtr& seen) {
    const int x = u - seen->u0, y = v - seen->v0;
    return seen->label.contains(x, y) && seen->label.at(x, y) == PixelLabel::hand;
  });
}

double ObservedDepth::depth(int u, int v) const {
  return frame_->depth.contains(u, v) ? frame_->depth.at(u, v) * frame_->depth_unit : 0;
}

/// The mean depth of a pixel and those of its neighbours that seem to be of the same surface [m]; 0: no measurement.
/// Without averaging, points that noise moves into a thin wall would be taken for its other side.
double ObservedDepth::smoothed(int u, int v) const {
  const double z = depth(u, v);
  if (z <= 0) return 0;
  double sum = 0;
  int count = 0;
  for (int y = v - 1; y <= v + 1; ++y)
    for (int x = u - 1; x <= u + 1; ++x) {
      const double neighbour = depth(x, y);
      if (std::abs(neighbour - z) > kAveraged) continue;
      sum += neighbour;
      ++count;
    }
  return sum / count;
}

/// Whether a neighbour of the pixel with the smoothed depth z shows another surface. Such a pixel may measure a place
/// between both.
bool ObservedDepth::at_edge(int u, int v, double z) const {
  const auto differs = [&](int x, int y) {
    const double neighbour = smoothed(x, y);
    return neighbour > 0 && std::abs(neighbour - z) > kEdge;
  };
  return differs(u - 1, v) || differs(u + 1, v) || differs(u, v - 1) || differs(u, v + 1);
}

void ObservedDepth::points_near(const KnownObject& object, const SE3& T_camera_object, double reach, std::size_t most,
                                std::vector<Vector3f>& points) const {
  // Find the part of the image that the object can be in.
  const Intrinsics& camera = frame_->camera;
  const Vector3d centre = T_camera_object * object.centre;
  if (centre.z() < object.radius + 0.05) return;
  const Eigen::Vector2d middle = camera.project(centre);
  const double radius = camera.fx * (object.radius + reach) / (centre.z() - object.radius);

  // Clip it to the image.
  const int u0 = std::max(0, static_cast<int>(middle.x() - radius));
  const int u1 = std::min(camera.width - 1, static_cast<int>(middle.x() + radius));
  const int v0 = std::max(0, static_cast<int>(middle.y() - radius));
  const int v1 = std::min(camera.height - 1, static_cast<int>(middle.y() + radius));

  // Collect the pixels in it that are near the surface and no hand's, on a grid.
  const SE3 T_object_camera = T_camera_object.inverse();
  const std::size_t before = points.size();
  const auto collect = [&](int step) {
    points.resize(before);
    for (int v = v0; v <= v1; v += step)
      for (int u = u0; u <= u1 && points.size() < before + most; u += step) {
        const double raw = depth(u, v);
        if (std::abs(raw - centre.z()) > object.radius + reach) continue;
        const Vector3d ray = camera.unproject(u, v, 1);
        const auto distance = [&](double z) {
          return object.grid.distance((T_object_camera * (z * ray)).cast<float>());
        };
        if (distance(raw) > reach + kAveraged * ray.norm() || of_hand(u, v)) continue;
        const double z = smoothed(u, v);
        if (distance(z) > reach || at_edge(u, v, z)) continue;
        points.push_back((z * ray).cast<float>());
      }
  };

  // The grid gets finer for a thin object, which covers little of this part.
  const double area = std::max(0.0, 1.0 + u1 - u0) * std::max(0.0, 1.0 + v1 - v0);
  const int coarse = std::max(1, static_cast<int>(std::sqrt(0.4 * area / static_cast<double>(most))));
  collect(coarse);
  const double covered = coarse * std::sqrt(static_cast<double>(points.size() - before) / static_cast<double>(most));
  if (const int fine = std::max(1, static_cast<int>(std::ceil(covered))); fine < coarse) collect(fine);
}

/// What the pixel of a place at depth `z` shows of it. Edges are measured wrongly by a pixel, and most of a thin object
/// is edge: the place is seen if a neighbour of the pixel shows it.
int Visibility::*ObservedDepth::shows(int u, int v, double z, double alike) const {
  const double measured = depth(u, v);
  if (measured <= 0) return &Visibility::hidden;
  const bool before = measured < z - alike;
  const bool behind = measured > z + alike;
  if (!behind && of_hand(u, v)) return &Visibility::hidden;
  if (!before && !behind) return &Visibility::seen;

  // Look at the neighbours.
  for (int y = v - 1; y <= v + 1; ++y)
    for (int x = u - 1; x <= u + 1; ++x)
      if (std::abs(depth(x, y) - z) <= alike && !of_hand(x, y)) return &Visibility::seen;
  return before ? &Visibility::blocked : &Visibility::through;
}

/// Calls `visit` with the pixel, the place and the normal (camera frame) of each of the first samples that face the
/// camera, are not hidden by the object itself, and whose pixel is `wanted`.
template <class Wanted, class Visit>
void ObservedDepth::visit_visible(const KnownObject& object, const SE3& T_camera_object, std::size_t samples,
                                  Wanted wanted, Visit visit) const {
  const Eigen::Matrix3f R = T_camera_object.R.cast<float>();
  const Vector3f t = T_camera_object.t.cast<float>(), camera_in_object = -(R.transpose() * t);
  for (std::size_t i = 0; i < std::min(samples, object.samples.size()); ++i) {
    const SurfaceSample& sample = object.samples[i];
    const Vector3f to_camera = (camera_in_object - sample.p).normalized();
    if (sample.n.dot(to_camera) < kSlant) continue;
    const Vector3d p = (R * sample.p + t).cast<double>();
    if (p.z() <= 0) continue;
    const Eigen::Vector2d pixel = frame_->camera.project(p);
    if (wanted(pixel) && !hides_itself(object, sample.p, to_camera))
      visit(pixel, p, (R * sample.n).cast<double>().eval());
  }
}

Visibility ObservedDepth::visibility(const KnownObject& object, const SE3& T_camera_object, std::size_t samples) const {
  // Count the samples by what lies in front of them or behind them.
  Visibility visibility;
  const double alike = kAlike + 2 * noise_;
  const auto all = [](const Eigen::Vector2d&) { return true; };
  visit_visible(object, T_camera_object, samples, all,
                [&](const Eigen::Vector2d& pixel, const Vector3d& p, const Vector3d&) {
                  const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
                  ++(visibility.*shows(u, v, p.z(), alike));
                });
  return visibility;
}

double ObservedDepth::continued(const KnownObject& object, const SE3& T_camera_object) const {
  // Find the last visible place in each direction of the image.
  struct Last {
    double along = -std::numeric_limits<double>::infinity();  // [px]
    Vector3d p, normal;
  };
  std::array<Last, kDirections> last;
  static const std::array<Eigen::Vector2d, kDirections> directions = directions_around();
  const auto farther = [&](const Eigen::Vector2d& pixel) {
    for (std::size_t k = 0; k < kDirections; ++k)
      if (directions[k].dot(pixel) > last[k].along) return true;
    return false;
  };
  visit_visible(object, T_camera_object, object.samples.size(), farther,
                [&](const Eigen::Vector2d& pixel, const Vector3d& p, const Vector3d& normal) {
                  for (std::size_t k = 0; k < kDirections; ++k)
                    if (const double along = directions[k].dot(pixel); along > last[k].along)
                      last[k] = {along, p, normal};
                });

  // What a pixel shows of the plane through a place: -1 nothing is known, 0 another surface, 1 the plane.
  const auto shows_plane = [&](const Last& place, double beyond, std::size_t k) {
    const Eigen::Vector2d pixel =
        frame_->camera.project(place.p) + beyond * frame_->camera.fx / place.p.z() * directions[k];
    const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    const double measured = smoothed(u, v);
    if (measured <= 0 || of_hand(u, v)) return -1;
    const Vector3d ray = frame_->camera.unproject(pixel.x(), pixel.y(), 1);
    const double z = place.normal.dot(place.p) / place.normal.dot(ray);
    return std::abs(measured - z) < kInPlane + 2 * noise_ ? 1 : 0;
  };

  // Look beyond these places.
  int looked = 0, continues = 0;
  for (std::size_t k = 0; k < kDirections; ++k) {
    if (std::isinf(last[k].along)) return 0;
    const int near = shows_plane(last[k], kNearBeyond, k), far = shows_plane(last[k], kFarBeyond, k);
    if (near < 0 || far < 0) continue;
    ++looked;
    continues += near == 1 && far == 1;
  }
  return continues / std::max(1.0, static_cast<double>(looked));
}

}  // namespace barehand
