// The terms of the energy that couple a hand with known objects.
#include "stages/refinement/object_contact.h"

#include "math/square.h"

#include <algorithm>

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr double kHidden = 0.5;  // tips that are more hidden than this show nothing of the grip
// A grip is firm if a tip that is seen is within kTouching of the object, and none if all are beyond kApart [m].
constexpr double kTouching = 0.0035, kApart = 0.0055;

Vector3f point_of(const SegmentSurface& surface, std::size_t i) { return {surface.x[i], surface.y[i], surface.z[i]}; }

}  // namespace

ObjectContact::ObjectContact(const ObjectContactParams& params, HandSurface surface)
    : params_(params), surface_(std::move(surface)) {
  for (int s = 0; s < kSegmentCount; ++s) {
    Sphere& sphere = spheres_[s];
    const SegmentSurface& skin = surface_[s];
    for (std::size_t i = 0; i < skin.size(); ++i) sphere.centre += point_of(skin, i) / static_cast<float>(skin.size());
    for (std::size_t i = 0; i < skin.size(); ++i)
      sphere.radius = std::max(sphere.radius, (point_of(skin, i) - sphere.centre).norm());
  }
}

ObjectContact::Nearest ObjectContact::nearest(const SE3& T_camera_segment, int segment, const DistanceGrid& grid,
                                              const SE3& T_camera_object) const {
  const SE3 T_object_segment = T_camera_object.inverse() * T_camera_segment;
  const Eigen::Matrix3f R = T_object_segment.R.cast<float>();
  const Vector3f t = T_object_segment.t.cast<float>();
  const auto reach = static_cast<float>(DistanceGrid::kMargin);

  // Leave out segments that are far away.
  Nearest best;
  const Sphere& sphere = spheres_[segment];
  if (grid.distance(R * sphere.centre + t) > sphere.radius + reach) return best;

  // Find the nearest point of the skin.
  DistanceGrid::Sample least{reach, Vector3f::Zero()};
  Vector3f point = Vector3f::Zero();
  for (std::size_t i = 0; i < surface_[segment].size(); ++i) {
    const Vector3f p = point_of(surface_[segment], i);
    const DistanceGrid::Sample sample = grid.sample(R * p + t);
    if (sample.distance >= least.distance) continue;
    least = sample;
    point = p;
  }
  best.distance = least.distance;
  best.point = T_camera_segment * point.cast<double>();
  best.gradient = T_camera_object.R * least.gradient.cast<double>();
  return best;
}

std::array<ObjectContact::Nearest, kSegmentCount> ObjectContact::nearest_of_all(const HandPose& pose,
                                                                                const DistanceGrid& grid,
                                                                                const SE3& T_camera_object) const {
  std::array<Nearest, kSegmentCount> near;
  for (int s = segment_of(0, 0); s < kSegmentCount; ++s) near[s] = nearest(pose[s], s, grid, T_camera_object);
  return near;
}

/// How firmly the hand grips an object, from 0 to 1. A hand that opens shows that by the tips that are seen; if none
/// is, it may grip. A single tip also lies on an object that the hand only reaches for, so that the second nearest
/// decides if several are seen.
double ObjectContact::grip(const std::array<Nearest, kSegmentCount>& near,
                           const std::array<double, kSegmentCount>& hidden, bool held) const {
  double first = DistanceGrid::kMargin, second = first;
  int seen = 0;
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const int tip = segment_of(finger, 2);
    if (hidden[tip] > kHidden) continue;
    ++seen;
    second = std::min(second, std::max(first, near[tip].distance));
    first = std::min(first, near[tip].distance);
  }
  if (seen == 0) return held ? 1 : 0;
  return std::clamp((kApart - (seen > 1 ? second : first)) / (kApart - kTouching), 0.0, 1.0);
}

ObjectContact::Terms ObjectContact::add_terms(const HandPose& pose, std::span<const NearbyObject> objects,
                                              const std::array<double, kSegmentCount>& hidden,
                                              GaussianTree& tree) const {
  Terms result;
  for (const NearbyObject& nearby : objects) {
    const auto nearest_of = nearest_of_all(pose, nearby.object->grid, nearby.pose(pose[kPalm]));
    const double firm = grip(nearest_of, hidden, nearby.holder_id >= 0);

    // Add the distance of each segment.
    for (int s = segment_of(0, 0); s < kSegmentCount; ++s) {
      const Nearest& near = nearest_of[s];
      const double d = near.distance;
      if (d >= DistanceGrid::kMargin) continue;

      // A tip that is not seen rests on what the hand holds if its pad, away from the back of the hand, faces that.
      double information = 1 / (square(params_.sigma_inside) + square(nearby.deviation)), root = 1;
      double holds = firm * hidden[s];
      if (d > 0) {
        if (!is_tip(s)) continue;
        holds *= std::clamp(near.gradient.dot(pose[s].R.col(1)), 0.0, 1.0);
        information = holds / (square(params_.sigma_touch) + square(nearby.deviation));
        root = square(params_.touch_scale) / (square(params_.touch_scale) + square(d));
      }
      if (is_tip(s)) {
        double& rests = result.rests[finger_of(s)];
        rests = std::max(rests, holds * root);
      }

      // Add the distance with the weight of the robust loss.
      const Vector6d row = point_jacobian(near.point - pose[s].t).transpose() * near.gradient;
      tree.H_self[s] += information * square(root) * row * row.transpose();
      tree.g[s] -= information * square(root) * d * row;
      result.energy += information * root * square(d);
    }
  }
  return result;
}

}  // namespace barehand
