#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hand/segments.h"
#include "math/se3.h"

namespace barehand {

/// One degree of freedom of a joint, as a hand profile states it.
struct JointDof {
  std::string name;                                  ///< for example "index_mcp_flex"
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitX();  ///< unit vector in the segment frame
  double lower = 0, upper = 0;                       ///< [rad]
};

/// Size, shape and rest pose of one segment. End 0 is proximal, end 1 distal.
struct SegmentProfile {
  SE3 T_hand_segment;                                        ///< at rest (open flat hand)
  double length = 0;                                         ///< [m]
  Eigen::Vector3d distal = Eigen::Vector3d::Zero();          ///< distal end in the segment frame [m]
  std::array<double, 2> radius{};                            ///< tapered round skin around the bone [m]
  std::array<double, 2> half_width{}, half_thickness{};      ///< elliptic skin along x and y [m]; = radius if absent
  std::array<double, 2> flesh_offset_x{}, flesh_offset_y{};  ///< skin centre relative to the bone [m]
  std::vector<JointDof> dofs;                                ///< in the order applied; empty for the palm
};

/// How well a profile knows the person's hand: the person was measured, or it is an average of many people, or such an
/// average fitted to the skin that the tracker saw, within which the joints keep to the average.
enum class ProfileOrigin { measured, mean, fitted };

struct Skin;

/// A person's hand. Hand frame: origin at the wrist joint, -z towards the fingers, +y out of the back of the hand.
/// Posed frame = parent frame * rest_relative * R(dof 1) * R(dof 2). File form: hand.json.
struct HandProfile {
  Handedness handedness = Handedness::right;
  ProfileOrigin origin = ProfileOrigin::measured;
  std::array<SegmentProfile, kSegmentCount> segments;
  std::shared_ptr<const Skin> scanned_skin;  ///< of a scan; null: the sections of the segments say it

  /// inverse(parent rest) * rest: where the child's frame sits in its parent at zero joint angles.
  SE3 rest_relative(int segment) const;
  /// Wrist to middle fingertip at rest [m].
  double hand_length() const;
};

/// The same person's other hand: everything reflected in the plane x = 0 of the hand frame. Joint limits keep their
/// meaning (flexion towards the palm, abduction away from the middle finger).
HandProfile mirrored(const HandProfile& profile);

/// The hand of somebody who is `size` times as large.
HandProfile scaled(const HandProfile& profile, double size);

}  // namespace barehand
