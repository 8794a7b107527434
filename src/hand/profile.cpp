#include "hand/profile.h"

namespace barehand {

SE3 HandProfile::rest_relative(int segment) const {
  if (segment == kPalm) return segments[kPalm].T_hand_segment;
  return segments[parent_of(segment)].T_hand_segment.inverse() * segments[segment].T_hand_segment;
}

double HandProfile::hand_length() const {
  const SegmentProfile& tip = segments[segment_of(2, 2)];
  return (tip.T_hand_segment * tip.distal - segments[kPalm].T_hand_segment.t).norm() + tip.radius[1];
}

}  // namespace barehand
