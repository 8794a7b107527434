#pragma once

#include <array>
#include <string_view>

#include "hand/hand_pose.h"

namespace barehand {

inline constexpr int kGloveJointCount = 21;
inline constexpr int kGloveChannelCount = 22;

/// glove_state_t's joint names, in its order.
extern const std::array<std::string_view, kGloveJointCount> kGloveJointNames;

/// Everything a glove would measure [rad]; NaN where it cannot be observed.
struct GloveAngles {
  std::array<double, kGloveJointCount> joint;
  std::array<double, kGloveChannelCount> channel;  ///< CyberGlove order
};

/// Joint angles against the profile's rest pose; between neighbouring fingers, the angle of their proximal phalanges
/// in the plane of the palm. See lcmtypes/glove_state_t.lcm for the meaning of every value.
GloveAngles glove_angles(const HandProfile& profile, const HandPose& pose);

/// The two segments a value depends on; -1: none (it cannot be observed).
struct GloveSegments {
  int a = -1, b = -1;
};
GloveSegments segments_of_joint(int joint);
GloveSegments segments_of_channel(int channel);

}  // namespace barehand
