#include "golden_messages.h"

#include <iterator>
#include <limits>
#include <string>
#include <type_traits>

namespace barehand::golden {
namespace {

constexpr std::int64_t kTime = 1'234'567'890'123'456;

/// Returns another number in every call, so that two swapped fields change the bytes.
class Counter {
 public:
  template <class T>
  void fill(T& value) {
    if constexpr (std::is_array_v<T>) {
      for (auto& element : value) fill(element);
    } else if constexpr (std::is_floating_point_v<T>) {
      value = 0.125 * ++count_ - 3;
    } else {
      value = static_cast<T>(++count_);
    }
  }

 private:
  int count_ = 0;
};

template <class Message>
void fill_header(Message& message) {
  message.utime = kTime;
  message.frame_number = 17;
  message.sensor = "left camera";
  message.hand_id = 3;
  message.handedness = hand_state_t::RIGHT;
  message.status = hand_state_t::HOLDING;
}

}  // namespace

rgbd_frame_t rgbd_frame() {
  rgbd_frame_t m;
  m.utime = kTime;
  m.seq = 4711;
  m.sensor = "left camera";
  m.width = 3;
  m.height = 2;

  // Every number differs, so that exchanged fields are noticed.
  m.fx = 525.5;
  m.fy = 524.25;
  m.cx = 1.5;
  m.cy = 0.75;
  m.depth_unit = 0.0001;

  m.depth_encoding = rgbd_frame_t::DEPTH_RAW16;
  m.depth = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  m.depth_size = static_cast<std::int32_t>(m.depth.size());
  m.colour_encoding = rgbd_frame_t::COLOUR_RAW_RGB;
  for (std::uint8_t i = 0; i < 18; ++i) m.colour.push_back(static_cast<std::uint8_t>(200 + i));
  m.colour_size = static_cast<std::int32_t>(m.colour.size());
  return m;
}

hand_state_t hand_state() {
  hand_state_t m;
  fill_header(m);
  m.has_pose = true;
  m.pose_utime = kTime - 33'333;
  m.score = 0.0015;
  m.joint_gap = 0.002;

  // Give every number of the segments another value.
  Counter counter;
  for (segment_state_t& s : m.segments) {
    counter.fill(s.position);
    counter.fill(s.orientation);
    counter.fill(s.distal);
    counter.fill(s.smoothed_position);
    counter.fill(s.smoothed_orientation);

    counter.fill(s.smoothed_distal);
    counter.fill(s.linear_velocity);
    counter.fill(s.angular_velocity);
    counter.fill(s.covariance);
    counter.fill(s.confidence);
    counter.fill(s.visible);
    s.seen = (&s - m.segments) % 2 == 0;
  }
  return m;
}

glove_state_t glove_state() {
  glove_state_t m;
  fill_header(m);
  for (std::size_t i = 0; i < std::size(m.joint_name); ++i) m.joint_name[i] = "joint_" + std::to_string(i);
  Counter counter;
  counter.fill(m.joint_angle);
  counter.fill(m.joint_angle_raw);
  counter.fill(m.joint_flag);
  counter.fill(m.channel);
  counter.fill(m.channel_raw);
  counter.fill(m.channel_flag);
  m.channel[glove_state_t::PALM_ARCH] = std::numeric_limits<double>::quiet_NaN();
  return m;
}

hand_joints_t hand_joints() {
  hand_joints_t m;
  fill_header(m);
  Counter counter;
  counter.fill(m.position);
  counter.fill(m.orientation);
  counter.fill(m.radius);
  counter.fill(m.flags);
  return m;
}

grasp_state_t grasp_state() {
  grasp_state_t m;
  fill_header(m);
  Counter counter;
  for (std::int8_t* field : {&m.grasp, &m.kind, &m.opposition, &m.thumb, &m.first_finger, &m.last_finger})
    counter.fill(*field);
  for (double* field : {&m.probability, &m.kind_probability, &m.opposition_probability, &m.thumb_probability,
                        &m.finger_probability, &m.aperture, &m.closure})
    counter.fill(*field);
  m.since = m.utime - 1;
  counter.fill(m.probabilities);
  return m;
}

contact_state_t contact_state() {
  contact_state_t m;
  fill_header(m);
  Counter counter;
  for (auto* contacts : {&m.object, &m.own, &m.other_hand})
    for (segment_contact_t& c : *contacts) {
      counter.fill(c.state);
      c.inferred = (&c - *contacts) % 2 == 0;
      counter.fill(c.probability);
      counter.fill(c.distance);

      counter.fill(c.deviation);
      counter.fill(c.point);
      counter.fill(c.normal);
      counter.fill(c.point_in_object);
      counter.fill(c.normal_in_object);
      counter.fill(c.partner);
      counter.fill(c.segment);
    }
  return m;
}

object_state_t object_state() {
  object_state_t m;
  m.utime = kTime;
  m.frame_number = 17;
  m.sensor = "left camera";
  Counter counter;

  // Give every number another value.
  counter.fill(m.object_id);
  counter.fill(m.position);
  counter.fill(m.orientation);
  counter.fill(m.linear_velocity);
  counter.fill(m.angular_velocity);
  counter.fill(m.covariance);
  counter.fill(m.extent);
  m.held = true;
  counter.fill(m.hand_id);
  m.since = kTime - 5'000'000;
  return m;
}

health_t health() {
  health_t m;
  Counter counter;
  m.utime = kTime;
  m.source = "folder:/data/fist";

  // Give every number another value.
  counter.fill(m.captured);
  counter.fill(m.published);
  counter.fill(m.dropped);
  counter.fill(m.failed);
  counter.fill(m.skipped);
  counter.fill(m.latency_count);
  counter.fill(m.latency_mean);
  counter.fill(m.latency_p50);
  counter.fill(m.latency_p95);
  counter.fill(m.latency_p99);
  counter.fill(m.latency_max);

  // Add two stages and a queue.
  m.stages = {{"preprocess", 30, 0.001, 0.002, 0.003, 0.004, 0.005, 6},
              {"fusion", 29, 0.011, 0.012, 0.013, 0.014, 0.015, 7}};
  m.n_stages = static_cast<std::int32_t>(m.stages.size());
  m.queues = {{"door", 1, 2, 33, 30, 2}};
  m.n_queues = static_cast<std::int32_t>(m.queues.size());
  return m;
}

command_t command() {
  command_t m;
  Counter counter;
  m.utime = kTime;
  m.sensor = "left camera";
  m.hand_id = command_t::ANY_HAND;
  m.command = command_t::INITIALISE;
  counter.fill(m.position);
  counter.fill(m.orientation);
  m.profile = "{\"handedness\": \"left\"}";
  return m;
}

}  // namespace barehand::golden
