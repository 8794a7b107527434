// Operations on hand profiles, such as scaling and mirroring.
#include "hand/profile.h"

#include "hand/skin.h"

namespace barehand {

SE3 HandProfile::rest_relative(int segment) const {
  if (segment == kPalm) return segments[kPalm].T_hand_segment;
  return segments[parent_of(segment)].T_hand_segment.inverse() * segments[segment].T_hand_segment;
}

double HandProfile::hand_length() const {
  const SegmentProfile& tip = segments[segment_of(2, 2)];
  return (tip.T_hand_segment * tip.distal - segments[kPalm].T_hand_segment.t).norm() + tip.radius[1];
}

HandProfile mirrored(const HandProfile& profile) {
  const Eigen::Vector3d flip(-1, 1, 1);
  HandProfile other = profile;
  other.handedness = opposite(profile.handedness);
  for (SegmentProfile& segment : other.segments) {
    // M R M with M = diag(flip) keeps a frame right-handed, with -z along the bone and +y dorsal.
    segment.T_hand_segment.R = flip.asDiagonal() * segment.T_hand_segment.R * flip.asDiagonal();
    segment.T_hand_segment.t = segment.T_hand_segment.t.cwiseProduct(flip);
    segment.distal = segment.distal.cwiseProduct(flip);
    for (double& x : segment.flesh_offset_x) x = -x;
    // M R(a, angle) M = R(-M a, angle), since a rotation axis is a pseudovector.
    for (JointDof& dof : segment.dofs) dof.axis = -dof.axis.cwiseProduct(flip);
  }
  if (profile.scanned_skin) other.scanned_skin = std::make_shared<const Skin>(mirrored(*profile.scanned_skin));
  return other;
}

HandProfile scaled(const HandProfile& profile, double size) {
  HandProfile result = profile;
  for (SegmentProfile& s : result.segments) {
    s.T_hand_segment.t *= size;
    s.length *= size;
    s.distal *= size;
    for (auto* at_ends : {&s.radius, &s.half_width, &s.half_thickness, &s.flesh_offset_x, &s.flesh_offset_y})
      for (double& value : *at_ends) value *= size;
  }
  if (profile.scanned_skin) result.scanned_skin = std::make_shared<const Skin>(scaled(*profile.scanned_skin, size));
  return result;
}

}  // namespace barehand
