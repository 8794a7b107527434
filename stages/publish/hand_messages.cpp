// Converts an estimate to the LCM messages of a hand.
#include "stages/publish/hand_messages.h"

#include <cassert>
#include <limits>
#include <utility>

#include "hand/joint_angles.h"
#include "stages/publish/glove_angles.h"
#include "stages/publish/message_fields.h"
#include "stages/publish/openxr_joints.h"

namespace barehand {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Everything that the messages of one frame are made of; without a pose, `profile` and both poses are meaningless.
struct FrameState {
  const HandEstimate& estimate;
  const PublishedTrack& track;
  const HandProfile* profile;
  HandPose raw, smoothed;
};

template <class Message>
void fill_header(Message& message, const FrameState& frame) {
  message.utime = frame.estimate.utime;
  message.frame_number = frame.estimate.number;
  message.sensor = frame.estimate.sensor;
  message.hand_id = frame.estimate.hand_id;
  message.handedness = frame.estimate.handedness == Handedness::left ? hand_state_t::LEFT : hand_state_t::RIGHT;
  message.status = static_cast<std::int8_t>(frame.track.status);
}

template <class T, std::size_t N>
void fill(T (&values)[N], T value) {
  for (T& v : values) v = value;
}
template <class T, std::size_t N, std::size_t M>
void fill(T (&values)[N][M], T value) {
  for (auto& row : values) fill(row, value);
}

segment_state_t unknown_segment() {
  segment_state_t out{};
  for (auto* vector : {&out.position, &out.distal, &out.smoothed_position, &out.smoothed_distal, &out.linear_velocity,
                       &out.angular_velocity}) {
    fill(*vector, kNaN);
  }
  fill(out.orientation, kNaN);
  fill(out.smoothed_orientation, kNaN);
  fill(out.covariance, kNaN);
  out.confidence = out.visible = kNaN;
  out.seen = false;
  return out;
}

segment_state_t segment_message(const FrameState& frame, int s) {
  const SegmentState& state = frame.track.segments[static_cast<std::size_t>(s)];
  segment_state_t out{};

  // State the estimated and the smoothed pose.
  copy(frame.raw[s].t, out.position);
  copy(frame.raw[s].R, out.orientation);
  copy(distal_end(*frame.profile, frame.raw, s), out.distal);
  copy(frame.smoothed[s].t, out.smoothed_position);
  copy(frame.smoothed[s].R, out.smoothed_orientation);
  copy(distal_end(*frame.profile, frame.smoothed, s), out.smoothed_distal);

  // State the motion and the uncertainty.
  copy(state.velocity.head<3>(), out.linear_velocity);
  copy(state.velocity.tail<3>(), out.angular_velocity);
  copy(state.covariance, out.covariance);
  out.confidence = state.confidence;
  out.visible = state.visible;
  out.seen = state.seen;
  return out;
}

hand_state_t state_message(const FrameState& frame) {
  hand_state_t out{};
  fill_header(out, frame);
  out.has_pose = frame.track.has_pose;
  out.pose_utime = frame.track.pose_utime;
  out.score = frame.track.has_pose ? frame.estimate.score : kNaN;
  out.joint_gap = frame.track.has_pose ? frame.estimate.joint_gap : kNaN;
  for (int s = 0; s < kSegmentCount; ++s) {
    out.segments[s] = frame.track.has_pose ? segment_message(frame, s) : unknown_segment();
  }
  return out;
}

std::int8_t glove_flag(const FrameState& frame, GloveSegments segments) {
  if (!frame.track.has_pose || segments.a < 0) return glove_state_t::UNOBSERVABLE;
  const bool seen = frame.track.segments[static_cast<std::size_t>(segments.a)].seen &&
                    frame.track.segments[static_cast<std::size_t>(segments.b)].seen;
  return seen ? glove_state_t::SEEN : glove_state_t::INFERRED;
}

glove_state_t glove_message(const FrameState& frame) {
  glove_state_t out{};
  fill_header(out, frame);

  // Without a pose, all angles are undefined.
  GloveAngles raw, smoothed;
  for (GloveAngles* angles : {&raw, &smoothed}) {
    angles->joint.fill(kNaN);
    angles->channel.fill(kNaN);
  }
  if (frame.track.has_pose) {
    raw = glove_angles(*frame.profile, frame.raw);
    smoothed = glove_angles(*frame.profile, frame.smoothed);
  }

  // State the angles of the joints.
  for (std::size_t i = 0; i < kGloveJointCount; ++i) {
    out.joint_name[i] = kGloveJointNames[i];
    out.joint_angle[i] = smoothed.joint[i];
    out.joint_angle_raw[i] = raw.joint[i];
    out.joint_flag[i] = glove_flag(frame, segments_of_joint(static_cast<int>(i)));
  }

  // State the channels of a data glove.
  for (std::size_t i = 0; i < kGloveChannelCount; ++i) {
    out.channel[i] = smoothed.channel[i];
    out.channel_raw[i] = raw.channel[i];
    out.channel_flag[i] = glove_flag(frame, segments_of_channel(static_cast<int>(i)));
  }
  return out;
}

constexpr std::int32_t kValid =
    std::int32_t{hand_joints_t::ORIENTATION_VALID} | std::int32_t{hand_joints_t::POSITION_VALID};
constexpr std::int32_t kTracked =
    std::int32_t{hand_joints_t::ORIENTATION_TRACKED} | std::int32_t{hand_joints_t::POSITION_TRACKED};

hand_joints_t joints_message(const FrameState& frame) {
  hand_joints_t out{};
  fill_header(out, frame);

  // Without a pose, all joints are undefined.
  fill(out.position, kNaN);
  fill(out.orientation, kNaN);
  fill(out.radius, kNaN);
  if (!frame.track.has_pose) return out;

  // Fill in the pose of each joint.
  const auto joints = openxr_joints(*frame.profile, frame.smoothed);
  for (std::size_t i = 0; i < kOpenXrJointCount; ++i) {
    copy(joints[i].T_camera_joint.t, out.position[i]);
    copy(joints[i].T_camera_joint.R, out.orientation[i]);
    out.radius[i] = joints[i].radius;

    // All joints are valid, but only those of seen segments are tracked.
    out.flags[i] = kValid;
    const bool seen = frame.track.segments[static_cast<std::size_t>(joints[i].segment)].seen;
    if (seen) out.flags[i] |= kTracked;
  }
  return out;
}

}  // namespace

HandMessages HandMessageMaker::process(const HandEstimate& estimate) {
  if (estimate.profile) profile_ = estimate.profile;
  if (std::exchange(hand_id_, estimate.hand_id) != estimate.hand_id) smoother_.reset();
  const PublishedTrack track = hold_.update(estimate, params_);
  FrameState frame{estimate, track, profile_.get(), {}, {}};
  if (track.has_pose) {
    assert(profile_ && "an estimate with a pose has a profile");
    frame.raw = pose_of(track.segments);
    frame.smoothed = smoother_.smooth(frame.raw, estimate.utime, params_.smoothing);
  } else {
    smoother_.reset();
  }
  return {state_message(frame), glove_message(frame), joints_message(frame)};
}

}  // namespace barehand
