// Closes the fingers of a simulated hand around an object until they touch it.
#include "drivers/synthetic/sequences/grasp_planner.h"

#include <algorithm>
#include <limits>

namespace barehand::synthetic {
namespace {

constexpr double kContact = 0.0005;  // skin that is closer to the object than this touches it [m]
constexpr int kSteps = 300;          // number of steps from the open to the closed hand

/// Sets the angles of joint k of a finger between open (t = 0) and closed (t = 1).
void set_joint(FingerAngles& finger, const FingerAngles& open, const FingerAngles& closed, int k, double t) {
  finger.flexion[k] = (1 - t) * open.flexion[k] + t * closed.flexion[k];
  if (k == 0) finger.abduction = (1 - t) * open.abduction + t * closed.abduction;
}

}  // namespace

GraspPlanner::GraspPlanner(const HandRig& rig) : rig_(rig), skinner_(rig.mesh) {}

std::array<double, kSegmentCount> GraspPlanner::clearance(const HandAngles& angles, const SE3& T_palm_object,
                                                          const SignedDistance& object_distance) const {
  std::vector<Eigen::Vector3f> skin;
  skinner_.deform(pose_segments(rig_.profile, {SE3{}, angles}), skin);
  const SE3 T_object_palm = T_palm_object.inverse();
  std::array<double, kSegmentCount> nearest;
  nearest.fill(std::numeric_limits<double>::max());
  for (std::size_t v = 0; v < skin.size(); ++v) {
    double& segment = nearest[skinner_.vertex_segments()[v]];
    segment = std::min(segment, object_distance(T_object_palm * skin[v].cast<double>()));
  }
  return nearest;
}

SE3 GraspPlanner::place_at_palm(const SE3& T_palm_object, const Eigen::Vector3d& direction,
                                const SignedDistance& object_distance, const HandAngles& angles) const {
  SE3 T = T_palm_object;
  for (int i = 0; i < 60; ++i) {  // distances are never overestimated, so that no step goes beyond the contact
    const auto gap = clearance(angles, T, object_distance);
    const double missing = kContact - *std::min_element(gap.begin(), gap.end());
    if (std::abs(missing) < 1e-5) break;
    T.t += missing * direction;
  }
  return T;
}

HandAngles GraspPlanner::close(const HandAngles& open, const HandAngles& closed, const SE3& T_palm_object,
                               const SignedDistance& object_distance) const {
  HandAngles angles = open;
  std::array<int, kFingerCount> first_free{};  // first joint of each finger that still moves
  const SE3 T_object_palm = T_palm_object.inverse();
  std::vector<Eigen::Vector3f> skin, before;
  std::vector<double> margin;  // for every vertex: a lower bound of the distance that it can move before it touches
  for (int step = 1; step <= kSteps; ++step) {
    // Close all free joints by one step.
    for (int finger = 0; finger < kFingerCount; ++finger)
      for (int k = first_free[finger]; k < 3; ++k)
        set_joint(angles[finger], open[finger], closed[finger], k, static_cast<double>(step) / kSteps);
    skinner_.deform(pose_segments(rig_.profile, {SE3{}, angles}), skin);

    // Stop the joints of phalanges that touch the object. Only skin that may have come near is measured.
    margin.resize(skin.size(), 0);
    for (std::size_t v = 0; v < skin.size(); ++v) {
      const int segment = skinner_.vertex_segments()[v];
      if (segment == kPalm) continue;
      if (step > 1) margin[v] -= (skin[v] - before[v]).norm();
      int& free = first_free[finger_of(segment)];
      const int next = (segment - 1) % 3 + 1;

      // Skip skin that cannot touch yet, or whose joint has stopped already.
      if (margin[v] > 0 || free >= next) continue;
      margin[v] = object_distance(T_object_palm * skin[v].cast<double>()) - kContact;
      if (margin[v] < 0) free = next;
    }
    std::swap(before, skin);
  }
  return angles;
}

}  // namespace barehand::synthetic
