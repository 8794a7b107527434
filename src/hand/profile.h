#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hand/segments.h"
#include "math/se3.h"

namespace barehand {

// The hand profile: segments, joints and sizes of a person's hand.

/// One rotational degree of freedom of a joint, as a hand profile states it.
struct JointDof {
  std::string name;                                  ///< for example "index_mcp_flex"
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitX();  ///< unit vector in the segment frame
  double lower = 0, upper = 0;                       ///< joint limits [rad]
};

/// Size, shape, rest pose and joint of one segment. End 0 is proximal, end 1 distal.
struct SegmentProfile {
  SE3 T_hand_segment;                                    ///< rest pose (open, flat hand)
  double length = 0;                                     ///< length of the bone [m]
  Eigen::Vector3d distal = Eigen::Vector3d::Zero();      ///< distal end of the bone in the segment frame [m]
  std::array<double, 2> radius{};                        ///< radii of the round, tapered skin at both ends [m]
  std::array<double, 2> half_width{}, half_thickness{};  ///< elliptic skin along x and y [m]; equal to radius if absent
  std::array<double, 2> flesh_offset_x{}, flesh_offset_y{};  ///< skin centre relative to the bone [m]
  std::vector<JointDof> dofs;  ///< rotations of the joint in the order of application; empty for the palm
};

/// Where a profile comes from. measured: this person was measured or scanned; mean: the average of many people;
/// fitted: a mean hand adapted to the skin that the tracker saw, whose joints within that skin are still those of the
/// mean hand.
enum class ProfileOrigin { measured, mean, fitted };

struct Skin;

/// The model of a person's hand. Hand frame: origin at the wrist joint, -z towards the fingers, +y out of the back of
/// the hand. The frame of a posed segment is parent frame * rest_relative * R(dof 1) * R(dof 2). It is stored as
/// hand.json.
struct HandProfile {
  Handedness handedness = Handedness::right;
  ProfileOrigin origin = ProfileOrigin::measured;
  std::array<SegmentProfile, kSegmentCount> segments;
  std::shared_ptr<const Skin> scanned_skin;  ///< from a scan; null: the skin follows from the segments' sections

  /// inverse(parent rest) * rest: the segment's frame in that of its parent at zero joint angles.
  SE3 rest_relative(int segment) const;
  /// Distance from the wrist to the tip of the middle finger at rest [m].
  double hand_length() const;
};

/// The profile of a person's other hand: everything mirrored in the plane x = 0 of the hand frame. Joint limits keep
/// their meaning (flexion towards the palm, abduction away from the middle finger).
HandProfile mirrored(const HandProfile& profile);

/// The profile with all lengths multiplied by `size`.
HandProfile scaled(const HandProfile& profile, double size);

}  // namespace barehand
