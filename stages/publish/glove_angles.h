#pragma once

#include <array>
#include <string_view>

#include "hand/hand_pose.h"

namespace barehand {

inline constexpr int kGloveJointCount = 21;
inline constexpr int kGloveChannelCount = 22;

/// The joint names of glove_state_t, in its order.
extern const std::array<std::string_view, kGloveJointCount> kGloveJointNames;

/// The angles that a data glove would measure [rad]; NaN where they cannot be observed.
struct GloveAngles {
  std::array<double, kGloveJointCount> joint;
  std::array<double, kGloveChannelCount> channel;  ///< CyberGlove order
};

/// Joint angles relative to the profile's rest pose and, between neighbouring fingers, the angle of their proximal
/// phalanges in the plane of the palm. See lcmtypes/glove_state_t.lcm for the meaning of every value.
GloveAngles glove_angles(const HandProfile& profile, const HandPose& pose);

/// The two segments that a value depends on; -1: none, the value cannot be observed.
struct GloveSegments {
  int a = -1, b = -1;
};
GloveSegments segments_of_joint(int joint);
GloveSegments segments_of_channel(int channel);

}  // namespace barehand
