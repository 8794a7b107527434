#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/ros/cdr.h"
#include "io/ros/ros_hand.h"
#include "sensor/rgbd_frame.h"

namespace barehand::ros {

/// All that is told of one moment.
struct Scene {
  std::int64_t utime = 0;   ///< of the depth image
  std::int64_t number = 0;  ///< RgbdFrame::number
  FramePtr frame;           ///< null: the images are not known
  std::vector<HandState> hands;
  std::optional<health_t> health;   ///< none: not due
  double fps = 0;                   ///< nominal rate of frames, noted beside depth; 0: not known
  std::optional<int> jpeg_quality;  ///< of colour; none: lossless
  bool cloud = true;                ///< points besides the depth image
};

/// One topic on which a scene has something to say.
struct Topic {
  std::string name;  ///< "/camera/depth"
  std::string type;  ///< "sensor_msgs/msg/Image"
  std::string schema;
  std::map<std::string, std::string> metadata;  ///< what the messages need and cannot hold
  std::function<Result<Bytes>()> encode;        ///< the message; the scene must still be there
};

/// The keys of Topic::metadata: the unit of depth [m], the nominal rate [frames/s], the sensor's name.
inline constexpr const char *kDepthUnit = "depth_unit", *kFps = "fps", *kSensor = "sensor";

/// `scene` outlives what is returned. A hand without a pose has no joint states and transforms.
std::vector<Topic> topics_of(const Scene& scene);

}  // namespace barehand::ros
