// Computes the angles that a data glove would measure from a hand pose.
#include "stages/publish/glove_angles.h"

#include <cmath>
#include <limits>

#include "hand/joint_angles.h"

namespace barehand {

const std::array<std::string_view, kGloveJointCount> kGloveJointNames = {
    "thumb_cmc_flex",  "thumb_cmc_abd",   "thumb_mcp_flex", "thumb_mcp_abd",   "thumb_ip_flex",  "index_mcp_flex",
    "index_mcp_abd",   "index_pip_flex",  "index_dip_flex", "middle_mcp_flex", "middle_mcp_abd", "middle_pip_flex",
    "middle_dip_flex", "ring_mcp_flex",   "ring_mcp_abd",   "ring_pip_flex",   "ring_dip_flex",  "little_mcp_flex",
    "little_mcp_abd",  "little_pip_flex", "little_dip_flex"};

namespace {

constexpr int kThumb = 0, kIndex = 1;
constexpr int kThumbJoints = 5, kFingerJoints = 4;

/// Factor that turns angles about +y so that they are positive towards the thumb, on both hands: seen from the back
/// with the fingers up, a positive turn about +y moves a finger to the left, where a right hand has its thumb.
double towards_thumb(const HandProfile& profile) { return side_sign(profile.handedness); }

/// Direction of the proximal phalanx in the plane of the palm [rad], positive towards the thumb.
double azimuth(const HandProfile& profile, int finger, const JointAngles& angles) {
  const Eigen::Vector3d rest = -profile.rest_relative(segment_of(finger, 0)).R.col(2);
  return towards_thumb(profile) * (std::atan2(-rest.x(), -rest.z()) + angles.abduction);
}

/// The direction of the thumb's metacarpal [rad]: its rotation about the palm's long axis, and its angle to the index
/// finger's metacarpal.
struct ThumbDirection {
  double rotate, abduction;
};
ThumbDirection thumb_direction(const HandProfile& profile, const HandPose& pose) {
  const Eigen::Vector3d bone = -(pose[kPalm].R.transpose() * pose[segment_of(kThumb, 0)].R.col(2));
  const double radial = -towards_thumb(profile) * bone.x();
  const Eigen::Vector3d index = profile.rest_relative(segment_of(kIndex, 0)).t.normalized();
  return {std::atan2(-bone.y(), radial), std::atan2(bone.cross(index).norm(), bone.dot(index))};
}

}  // namespace

GloveAngles glove_angles(const HandProfile& profile, const HandPose& pose) {
  // Compute all joint angles. Channels that are not filled below cannot be observed.
  std::array<JointAngles, kSegmentCount> angle;
  for (int s = 0; s < kSegmentCount; ++s) angle[s] = joint_angles(profile, pose, s);
  const double side = towards_thumb(profile);
  GloveAngles glove;
  glove.channel.fill(std::numeric_limits<double>::quiet_NaN());

  // Fill in the joints, finger by finger.
  auto joint = glove.joint.begin();
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const JointAngles& a = angle[segment_of(finger, 0)];
    const JointAngles& b = angle[segment_of(finger, 1)];
    *joint++ = a.flexion;
    *joint++ = side * a.abduction;
    *joint++ = b.flexion;
    if (finger == kThumb) *joint++ = side * b.abduction;
    *joint++ = angle[segment_of(finger, 2)].flexion;
  }

  // Fill in the channels: those of the thumb, then each finger's flexions and its abduction from the finger before.
  const ThumbDirection thumb = thumb_direction(profile, pose);
  auto channel = glove.channel.begin();
  *channel++ = thumb.rotate;
  *channel++ = angle[segment_of(kThumb, 1)].flexion;
  *channel++ = angle[segment_of(kThumb, 2)].flexion;
  *channel++ = thumb.abduction;

  // Append the other fingers.
  for (int finger = kIndex; finger < kFingerCount; ++finger) {
    for (int k = 0; k < 3; ++k) *channel++ = angle[segment_of(finger, k)].flexion;
    if (finger == kIndex) continue;
    *channel++ = azimuth(profile, finger - 1, angle[segment_of(finger - 1, 0)]) -
                 azimuth(profile, finger, angle[segment_of(finger, 0)]);
  }
  return glove;
}

GloveSegments segments_of_joint(int joint) {
  if (joint < kThumbJoints) {
    const int k = joint < 2 ? 0 : joint < 4 ? 1 : 2;
    return {parent_of(segment_of(kThumb, k)), segment_of(kThumb, k)};
  }
  const int finger = kIndex + (joint - kThumbJoints) / kFingerJoints;
  const int place = (joint - kThumbJoints) % kFingerJoints;
  const int segment = segment_of(finger, place < 2 ? 0 : place - 1);
  return {parent_of(segment), segment};
}

GloveSegments segments_of_channel(int channel) {
  // The channels after the last finger (palm arch, wrist) are not observed.
  constexpr int kThumbChannels = 4, kIndexChannels = 3, kPalmArch = 19;
  if (channel >= kPalmArch) return {};

  // The thumb's and the index finger's channels.
  if (channel == 0 || channel == 3) return {kPalm, segment_of(kThumb, 0)};
  if (channel < kThumbChannels) return {segment_of(kThumb, channel - 1), segment_of(kThumb, channel)};
  if (channel < kThumbChannels + kIndexChannels) {
    const int segment = segment_of(kIndex, channel - kThumbChannels);
    return {parent_of(segment), segment};
  }

  // Each other finger has three flexions and an abduction.
  const int finger = kIndex + 1 + (channel - kThumbChannels - kIndexChannels) / 4;
  const int place = (channel - kThumbChannels - kIndexChannels) % 4;
  if (place == 3) return {segment_of(finger - 1, 0), segment_of(finger, 0)};
  return {parent_of(segment_of(finger, place)), segment_of(finger, place)};
}

}  // namespace barehand
