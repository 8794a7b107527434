#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

// The hand as an implicit surface: a signed distance to blended elliptic tubes.

/// Elliptic cross-section of a tube: half axes and centre along x and y [m].
struct EllipticSection {
  double half_x = 0, half_y = 0, centre_x = 0, centre_y = 0;
};

/// A tube of elliptic sections around a bone, with rounded ends: the building block of the smooth skin. In the tube's
/// own frame, the bone runs from the origin along -z over `length` [m].
struct EllipticTube {
  SE3 T_tube_hand;
  double length = 0;
  double middle = 0.5;                      ///< position of the second section, as a fraction of the length
  std::array<EllipticSection, 3> sections;  ///< sections at 0, `middle` and 1 of the length; linear in between
  std::array<double, 2> cap{};              ///< how far the rounding reaches beyond each end [m]

  /// Distance of a point in the hand frame to the surface [m]; first-order accurate near it, negative inside.
  double distance(const Eigen::Vector3d& p_hand) const;
};

/// A fold of skin between two bones: a tube across them and how smoothly it blends into them.
struct Web {
  EllipticTube tube;
  double blend = 0;  ///< width of the smooth transition into the bones' skin [m]
};

/// The hand as an implicit surface. It is built in a pose with spread fingers, so that neighbouring fingers do not
/// blend into each other. Phalanges follow the profile's sections; the palm consists of one tube per finger between
/// wrist and knuckle; a short tube across each pair of neighbouring fingers is the web between them.
class ImplicitHand {
 public:
  explicit ImplicitHand(const HandProfile& profile);

  /// Signed distance of a point in the hand frame [m]; smooth where palm, thumb and fingers meet.
  double distance(const Eigen::Vector3d& p) const;
  /// Signed distance to the nearest tube of one segment alone [m].
  double segment_distance(int segment, const Eigen::Vector3d& p) const;
  /// The pose (T_hand_segment) in which the surface is built.
  const HandPose& pose() const { return pose_; }

 private:
  HandPose pose_;
  std::vector<EllipticTube> tubes_;  // tubes of the palm, then of segments 1 to 15
  int palm_tubes_ = 0;
  std::vector<Web> webs_;
};

}  // namespace barehand
