#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/ros/cdr.h"
#include "io/ros/ros_hand.h"
#include "math/se3.h"
#include "sensor/rgbd_frame.h"

namespace barehand::ros {

// The ROS topics of a frame and its hands.

/// Everything that is published about one frame.
struct Scene {
  std::int64_t utime = 0;   ///< time stamp of the depth image [us since the epoch]
  std::int64_t number = 0;  ///< RgbdFrame::number
  FramePtr frame;           ///< null: the images are not known
  std::vector<HandState> hands;
  std::vector<object_state_t> objects = {};
  std::optional<health_t> health;     ///< counters of the pipeline; none: it is not their time
  double fps = 0;                     ///< nominal frame rate, stored as metadata of the depth topic; 0: unknown
  std::optional<int> jpeg_quality;    ///< JPEG quality of the colour image; none: lossless PNG
  std::optional<SE3> T_world_camera;  ///< none: the pose of the camera in the room is unknown
  bool cloud = true;                  ///< whether a point cloud is published in addition to the depth image
};

/// One topic and the message that a scene has for it.
struct Topic {
  std::string name;  ///< for example "/camera/depth"
  std::string type;  ///< for example "sensor_msgs/msg/Image"
  std::string schema;
  std::map<std::string, std::string> metadata;  ///< information that the messages have no field for
  std::function<Result<Bytes>()> encode;        ///< makes the message; the scene must still exist
};

/// Keys of Topic::metadata: the depth unit [m], the nominal frame rate [1/s], the sensor's name.
inline constexpr const char *kDepthUnit = "depth_unit", *kFps = "fps", *kSensor = "sensor";

/// The topics of a scene, which must outlive them. A hand without a pose has no joint states and transforms. Where
/// T_world_camera is known, the camera has a transform, to the frame "world".
std::vector<Topic> topics_of(const Scene& scene);

}  // namespace barehand::ros
