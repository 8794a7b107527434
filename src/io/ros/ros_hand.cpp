// Converts the LCM messages of a hand to ROS messages.
#include "io/ros/ros_hand.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/format.h"
#include "hand/grasps/grasp_types.h"
#include "hand/segments.h"
#include "hand/status_name.h"
#include "io/ros/ros_frame.h"
#include "io/ros/ros_time.h"

namespace barehand::ros {
namespace {

Header header_of(const hand_state_t& state) {
  return {time_of(state.utime).value_or(Time{}), camera_frame(state.sensor)};
}

/// Converts a quaternion from (w, x, y, z), the order in the LCM types.
Quaternion quaternion(const double (&q)[4]) { return {q[1], q[2], q[3], q[0]}; }
Quaternion quaternion(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
Point point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

// hand_joints_t begins with palm and wrist; the thumb has four joints, every other finger five.
constexpr int kWrist = 1, kThumb = 2;

/// The joint that precedes `joint` on the way from the wrist to the fingertip.
int joint_before(int joint) {
  if (joint <= kThumb || (joint - kThumb - 4) % 5 == 0) return kWrist;
  return joint - 1;
}

/// The segment that begins at a joint; for tips, the last segment of the finger; for other joints, the palm.
int segment_at(int joint) {
  if (joint < kThumb) return kPalm;
  if (joint < kThumb + 4) return std::min(1 + joint - kThumb, 3);
  const int finger = (joint - kThumb - 4) / 5 + 1, k = (joint - kThumb - 4) % 5;
  return k == 0 ? kPalm : segment_of(finger, std::min(k - 1, 2));
}

ColorRGBA colour_of(const segment_state_t& segment) {
  const auto sure = static_cast<float>(std::isfinite(segment.confidence) ? segment.confidence : 0);
  return {1 - sure, sure, 0.1F, segment.seen ? 1.0F : 0.4F};
}

/// Collects markers and sets their header, namespace, id and colour.
class Drawing {
 public:
  explicit Drawing(const HandState& hand) : hand_(hand), header_(header_of(hand.state)) {}

  Marker& add(const char* what, std::int32_t type, int segment) {
    Marker& marker = array_.markers.emplace_back();
    marker.header = header_;
    marker.ns = side_of(hand_.state) + "_" + what;
    marker.id = next_++;
    marker.type = type;
    marker.color = colour_of(hand_.state.segments[segment]);
    return marker;
  }
  MarkerArray take() { return std::move(array_); }

 private:
  const HandState& hand_;
  const Header header_;
  MarkerArray array_;
  std::int32_t next_ = 0;
};

void add_joint(const HandState& hand, int joint, Drawing& drawing) {
  Marker& sphere = drawing.add("skin", Marker::kSphere, segment_at(joint));
  const double size = 2 * hand.joints.radius[joint];
  sphere.pose.position = point(Eigen::Vector3d(hand.joints.position[joint]));
  sphere.scale = {size, size, size};
}

/// Adds a cylinder between a joint and the one before it.
void add_bone(const HandState& hand, int joint, Drawing& drawing) {
  const int before = joint_before(joint);
  const Eigen::Vector3d a(hand.joints.position[before]), b(hand.joints.position[joint]);
  Marker& bone = drawing.add("skin", Marker::kCylinder, segment_at(before == kWrist ? joint : before));
  const double width = hand.joints.radius[before == kWrist ? joint : before] + hand.joints.radius[joint];
  bone.pose.position = point((a + b) / 2);
  bone.pose.orientation = quaternion(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), b - a));
  bone.scale = {width, width, (b - a).norm()};
}

/// Adds the ellipsoid of two standard deviations of the position of the segment's proximal end.
void add_ellipsoid(const segment_state_t& segment, int s, Drawing& drawing) {
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) covariance(i, j) = segment.covariance[i][j];
  if (!covariance.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Eigen::Vector3d sigma = solver.eigenvalues().cwiseMax(0).cwiseSqrt();

  Marker& ellipsoid = drawing.add("uncertainty", Marker::kSphere, s);
  ellipsoid.pose.position = point(Eigen::Vector3d(segment.position));
  ellipsoid.pose.orientation = quaternion(Eigen::Quaterniond(axes));
  ellipsoid.scale = {4 * sigma.x(), 4 * sigma.y(), 4 * sigma.z()};
  ellipsoid.color = {0.2F, 0.4F, 1, 0.3F};
}

template <class M>
LcmMessage lcm_message(const Header& header, const char* channel, const M& message) {
  LcmMessage out{header, channel, {}};
  out.data.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(out.data.data(), 0, static_cast<int>(out.data.size()));
  return out;
}

KeyValue value(std::string key, double number) { return {std::move(key), formatted("%.6g", number)}; }
KeyValue value(std::string key, std::int64_t number) { return {std::move(key), std::to_string(number)}; }

}  // namespace

std::string side_of(const hand_state_t& state) { return state.handedness == hand_state_t::LEFT ? "left" : "right"; }

JointState joint_state(const HandState& hand) {
  JointState message;
  message.header = header_of(hand.state);
  for (int i = 0; i < 21; ++i) {
    if (hand.glove.joint_flag[i] == glove_state_t::UNOBSERVABLE) continue;
    message.name.push_back(side_of(hand.state) + "_" + hand.glove.joint_name[i]);
    message.position.push_back(hand.glove.joint_angle[i]);
  }
  return message;
}

void add_transforms(const HandState& hand, TFMessage& message) {
  for (int s = 0; s < kSegmentCount; ++s) {
    const segment_state_t& segment = hand.state.segments[s];
    TransformStamped& transform = message.transforms.emplace_back();
    transform.header = header_of(hand.state);
    transform.child_frame_id = side_of(hand.state) + "_" + std::string(kSegmentNames[static_cast<std::size_t>(s)]);
    const double(&p)[3] = segment.smoothed_position;
    transform.transform = {{p[0], p[1], p[2]}, quaternion(segment.smoothed_orientation)};
  }
}

void add_transform(const object_state_t& object, TFMessage& message) {
  TransformStamped& transform = message.transforms.emplace_back();
  transform.header = {time_of(object.utime).value_or(Time{}), camera_frame(object.sensor)};
  transform.child_frame_id = "object_" + std::to_string(object.object_id);
  transform.transform = {{object.position[0], object.position[1], object.position[2]}, quaternion(object.orientation)};
}

MarkerArray contact_markers(const HandState& hand) {
  constexpr double kSize = 0.008;  // diameter of a sphere [m]

  // First remove the spheres of the previous frame.
  Drawing drawing(hand);
  drawing.add("contacts", Marker::kSphere, kPalm).action = Marker::kDeleteAll;
  const auto& contact = *hand.contact;

  // Draw a sphere for each segment that touches.
  for (const auto* list : {contact.object, contact.own, contact.other_hand})
    for (int s = 0; s < kSegmentCount; ++s) {
      if (list[s].state != contact_state_t::TOUCHING) continue;
      Marker& sphere = drawing.add("contacts", Marker::kSphere, s);
      sphere.pose.position = point(Eigen::Vector3d(list[s].point));
      sphere.scale = {kSize, kSize, kSize};

      // Objects are orange, hands are blue, and inferred contacts are faint.
      const float alpha = list[s].inferred ? 0.4F : 1.0F;
      sphere.color = list == contact.object ? ColorRGBA{1, 0.5F, 0, alpha} : ColorRGBA{0.2F, 0.4F, 1, alpha};
    }
  return drawing.take();
}

MarkerArray markers(const HandState& hand) {
  Drawing drawing(hand);
  if (!hand.state.has_pose) {
    drawing.add("skin", Marker::kSphere, kPalm).action = Marker::kDeleteAll;
    return drawing.take();
  }
  for (int joint = kWrist; joint < 26; ++joint) add_joint(hand, joint, drawing);
  for (int joint = kThumb; joint < 26; ++joint) add_bone(hand, joint, drawing);
  for (int s = 0; s < kSegmentCount; ++s) add_ellipsoid(hand.state.segments[s], s, drawing);
  return drawing.take();
}

/// Adds what is known about the grasp.
void add_grasp(const grasp_state_t& grasp, std::vector<KeyValue>& values) {
  if (grasp.grasp == grasp_state_t::UNKNOWN) return;
  values.push_back({"grasp", std::string(grasp_name(grasp.grasp))});
  values.push_back(value("grasp probability", grasp.probability));
  values.push_back({"grasp kind", std::string(kind_name(grasp.kind))});
  values.push_back(value("grasp kind probability", grasp.kind_probability));
  values.push_back(value("aperture [m]", grasp.aperture));
  values.push_back(value("closure", grasp.closure));
}

DiagnosticStatus diagnostic(const HandState& hand) {
  // Summarise the state of the track.
  const auto status = static_cast<TrackStatus>(hand.state.status);
  DiagnosticStatus message;
  message.level = status == TrackStatus::tracking  ? DiagnosticStatus::kOk
                  : status == TrackStatus::holding ? DiagnosticStatus::kWarn
                                                   : DiagnosticStatus::kStale;
  message.name = "barehand: " + side_of(hand.state) + " hand";
  message.message = to_string(status);
  message.hardware_id = hand.state.sensor;

  // Add the numbers; those of the pose only if there is one.
  message.values = {value("hand_id", std::int64_t{hand.state.hand_id}), value("frame_number", hand.state.frame_number)};
  if (!hand.state.has_pose) return message;

  // Add how well the pose agrees with the data.
  message.values.push_back(value("score [m]", hand.state.score));
  message.values.push_back(value("joint_gap [m]", hand.state.joint_gap));
  if (hand.grasp) add_grasp(*hand.grasp, message.values);

  // Add the confidence of each segment.
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    const segment_state_t& segment = hand.state.segments[s];
    const std::string name(kSegmentNames[s]);
    message.values.push_back(value(name + " confidence", segment.confidence));
    message.values.push_back({name + " seen", segment.seen ? "true" : "false"});
  }
  return message;
}

std::vector<LcmMessage> lcm_messages(const HandState& hand) {
  const Header header = header_of(hand.state);
  std::vector<LcmMessage> messages = {lcm_message(header, "HAND_STATE", hand.state),
                                      lcm_message(header, "GLOVE_STATE", hand.glove),
                                      lcm_message(header, "HAND_JOINTS", hand.joints)};
  if (hand.contact) messages.push_back(lcm_message(header, "CONTACT_STATE", *hand.contact));
  if (hand.grasp) messages.push_back(lcm_message(header, "GRASP_STATE", *hand.grasp));
  return messages;
}

LcmMessage lcm_message(const object_state_t& object) {
  return lcm_message({time_of(object.utime).value_or(Time{}), camera_frame(object.sensor)}, "OBJECT_STATE", object);
}

DiagnosticStatus diagnostic(const health_t& health) {
  // Warn if frames were dropped, failed or were skipped.
  DiagnosticStatus message;
  message.level = health.dropped + health.failed + health.skipped > 0 ? DiagnosticStatus::kWarn : DiagnosticStatus::kOk;
  message.name = "barehand: pipeline";
  message.message = std::to_string(health.published) + " frames published";
  message.hardware_id = health.source;

  // Add the counts of frames and the latency.
  message.values = {value("captured", health.captured),
                    value("published", health.published),
                    value("dropped", health.dropped),
                    value("failed", health.failed),
                    value("skipped", health.skipped),
                    value("latency p50 [s]", health.latency_p50),
                    value("latency p99 [s]", health.latency_p99)};

  // Add the losses of each queue.
  for (const queue_health_t& queue : health.queues)
    message.values.push_back(value("queue " + queue.name + " dropped", queue.dropped));
  return message;
}

}  // namespace barehand::ros
