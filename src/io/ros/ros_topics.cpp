// The ROS topics and messages of a frame and its hands.
#include "io/ros/ros_topics.h"

#include <algorithm>

#include "core/format.h"
#include "io/ros/ros_frame.h"
#include "io/ros/ros_time.h"

namespace barehand::ros {
namespace {

/// A topic whose message is made by `make`. The schema is made only once for every type.
template <Message M>
Topic topic(std::string name, std::function<Result<M>()> make) {
  static const std::string type = schema_name<M>(), schema = SchemaText::of<M>();
  return {std::move(name), type, schema, {}, [make = std::move(make)]() -> Result<Bytes> {
            const auto message = make();
            if (!message) return tl::unexpected(message.error());
            return encode(*message);
          }};
}

/// "/camera", or the sensor's name with underscores for the characters that a topic's name must not have.
std::string camera_namespace(const std::string& sensor) {
  std::string name = sensor.empty() ? "camera" : sensor;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return "/" + name;
}

void add_frame(const Scene& scene, std::vector<Topic>& topics) {
  // Name the topics after the sensor, so that those of several sensors differ.
  const RgbdFrame* frame = scene.frame.get();
  const std::string space = camera_namespace(frame->sensor);
  std::vector<Topic> added;

  // Add the camera and the depth, with what a replay needs beyond the ROS types.
  added.push_back(topic<CameraInfo>(space + "/camera_info", [frame] { return camera_info(*frame); }));
  added.push_back(topic<Image>(space + "/depth", [frame] { return depth_image(*frame); }));
  added.back().metadata[kDepthUnit] = formatted("%.17g", frame->depth_unit);
  if (scene.fps > 0) added.back().metadata[kFps] = formatted("%.17g", scene.fps);

  // Add the colour and the point cloud, if there are any.
  if (!frame->colour.empty())
    added.push_back(topic<CompressedImage>(
        space + "/colour", [frame, quality = scene.jpeg_quality] { return colour_image(*frame, quality); }));
  if (scene.cloud) added.push_back(topic<PointCloud2>(space + "/points", [frame] { return point_cloud(*frame); }));

  // Mark all of them with the name of the sensor, if it has one.
  for (Topic& one : added) {
    if (!frame->sensor.empty()) one.metadata[kSensor] = frame->sensor;
    topics.push_back(std::move(one));
  }
}

/// The name of the camera's frame, after the sensor of the images or of the states.
std::string camera_frame_of(const Scene& scene) {
  if (scene.frame) return camera_frame(scene.frame->sensor);
  return camera_frame(scene.hands.empty() ? std::string() : scene.hands.front().state.sensor);
}

TFMessage transforms_of(const Scene& scene) {
  TFMessage message;
  if (scene.T_world_camera) {
    const Eigen::Quaterniond q(scene.T_world_camera->R);
    const Eigen::Vector3d& t = scene.T_world_camera->t;
    message.transforms.push_back({{time_of(scene.utime).value_or(Time{}), "world"},
                                  camera_frame_of(scene),
                                  {{t.x(), t.y(), t.z()}, {q.x(), q.y(), q.z(), q.w()}}});
  }
  for (const HandState& hand : scene.hands)
    if (hand.state.has_pose) add_transforms(hand, message);
  for (const object_state_t& object : scene.objects) add_transform(object, message);
  return message;
}

DiagnosticArray diagnostics_of(const Scene& scene) {
  DiagnosticArray message;
  message.header.stamp = time_of(scene.utime).value_or(Time{});
  for (const HandState& hand : scene.hands) message.status.push_back(diagnostic(hand));
  if (scene.health) message.status.push_back(diagnostic(*scene.health));
  return message;
}

}  // namespace

std::vector<Topic> topics_of(const Scene& scene) {
  // Add the images and the camera, if there is a frame.
  std::vector<Topic> topics;
  if (scene.frame) add_frame(scene, topics);

  // Add the transforms if any are known.
  const auto has_pose = [](const HandState& hand) { return hand.state.has_pose; };
  if (scene.T_world_camera || std::any_of(scene.hands.begin(), scene.hands.end(), has_pose))
    topics.push_back(topic<TFMessage>("/tf", [&scene] { return transforms_of(scene); }));

  // Add what is known of each hand.
  for (const HandState& hand : scene.hands) {
    const std::string space = "/" + side_of(hand.state) + "_hand";
    if (hand.state.has_pose)
      topics.push_back(topic<JointState>(space + "/joint_states", [&hand] { return joint_state(hand); }));
    topics.push_back(topic<MarkerArray>(space + "/markers", [&hand] { return markers(hand); }));
    if (hand.contact)
      topics.push_back(topic<MarkerArray>(space + "/contacts", [&hand] { return contact_markers(hand); }));
  }

  // Add the diagnostics, of hands and of the pipeline.
  if (!scene.hands.empty() || scene.health)
    topics.push_back(topic<DiagnosticArray>("/diagnostics", [&scene] { return diagnostics_of(scene); }));
  return topics;
}

}  // namespace barehand::ros
