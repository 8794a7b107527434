// Closes the hidden fingers of a hand that grips an object.
#include <algorithm>

#include "stages/refinement/object_contact.h"

namespace barehand {
namespace {

constexpr double kHiddenSegment = 0.9;  // segments that are less hidden stay where they are
constexpr double kFirm = 0.5;           // less firm grips close no finger
constexpr double kTouches = 5e-4;       // skin that is closer to an object touches it [m]
constexpr double kLeastStep = 0.01;     // least turn of a joint in one step [rad]
// A point of a finger moves by at most this much as its joints turn by 1 rad [m]: its distances from the three joints,
// which lie within 0.1 m, add up to less. So no step goes farther into an object than the least step does.
constexpr double kReach = 0.25;

}  // namespace

/// The flexion of a finger, closed from its joint `first` on.
std::optional<FingerFlexion> ObjectContact::close(int finger, int first, const HandProfile& profile,
                                                  const std::array<JointLimits, kSegmentCount>& limits,
                                                  const HandPose& pose, const DistanceGrid& grid,
                                                  const SE3& T_camera_object) const {
  // Begin straight.
  std::array<JointAngles, 3> angles;
  for (int k = 0; k < 3; ++k) {
    angles[k] = joint_angles(profile, pose, segment_of(finger, k));
    if (k >= first) angles[k].flexion = 0;
  }

  HandPose moved = pose;
  bool straight = true, touches = false;
  for (int free = first; free < 3; straight = false) {
    // Place the segments, and stop the joints of those that touch.
    double least = DistanceGrid::kMargin;
    for (int k = first; k < 3; ++k) {
      const int s = segment_of(finger, k);
      place_segment(profile, s, angles[k], moved);
      if (k < free) continue;
      const Nearest near = nearest(moved[s], s, grid, T_camera_object);
      if (near.distance >= kTouches) {
        least = std::min(least, near.distance);
        continue;
      }
      if (straight) return std::nullopt;
      free = k + 1;
      touches = is_tip(s) && near.gradient.dot(moved[s].R.col(1)) > 0;
    }

    // Bend the free joints by as much as surely leads through free space, up to their limits.
    const double turn = std::max(kLeastStep, least / kReach);
    bool moves = false;
    for (int k = free; k < 3; ++k) {
      const double most = limits[segment_of(finger, k)].flexion_hi;
      moves = moves || angles[k].flexion < most;
      angles[k].flexion = std::min(most, angles[k].flexion + (k == 2 ? kDistalShare : 1) * turn);
    }
    if (!moves) break;
  }
  if (!touches) return std::nullopt;
  return FingerFlexion{angles[0].flexion, angles[1].flexion, angles[2].flexion};
}

std::array<std::optional<FingerFlexion>, kFingerCount> ObjectContact::closed(
    const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits, const HandPose& pose,
    std::span<const NearbyObject> objects, const std::array<double, kSegmentCount>& hidden) const {
  std::array<std::optional<FingerFlexion>, kFingerCount> result;
  for (const NearbyObject& nearby : objects) {
    const DistanceGrid& grid = nearby.object->grid;
    const SE3 T_camera_object = nearby.pose(pose[kPalm]);
    if (grip(nearest_of_all(pose, grid, T_camera_object), hidden, nearby.holder_id >= 0) < kFirm) continue;
    for (int finger = 1; finger < kFingerCount; ++finger) {
      int first = 3;
      while (first > 0 && hidden[segment_of(finger, first - 1)] >= kHiddenSegment) --first;
      if (first < 3 && !result[finger])
        result[finger] = close(finger, first, profile, limits, pose, grid, T_camera_object);
    }
  }
  return result;
}

}  // namespace barehand
