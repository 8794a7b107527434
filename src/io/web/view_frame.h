#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/memory/frame_memory.h"
#include "io/overlay/colour_map.h"
#include "io/ros/ros_hand.h"
#include "io/web/view_request.h"
#include "io/web/view_skin.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

// A frame and its hands, encoded for the live page.

/// An encoded LCM message. The page gets the same messages as the LCM network.
struct ViewMessage {
  const char* channel = "";  ///< without a prefix: "HAND_STATE"
  FrameVector<std::uint8_t> bytes;
};

/// The part of a depth image that shows the hands.
struct ViewFocus {
  int u = 0, v = 0, width = 0, height = 0;  ///< first column and row, and size [px]
  double near = 0, far = 0;                 ///< range of depths [m]
};
/// The part of the depth image around `points` (camera frame [m]), with a margin; none if no point is in front of the
/// camera and in view.
std::optional<ViewFocus> focus_on(std::span<const Eigen::Vector3d> points, const Intrinsics& camera);

/// Where a frame lies in the log that is played.
struct LogPlace {
  std::int64_t position = 0;  ///< from 0
  double seconds = 0;         ///< since the first frame [s]
};

/// Everything that the page may show of one frame. Immutable once shared. Costly parts (point cloud, images) are made
/// on first use, on the thread of the client that needs them and never on a thread that tracks.
class ViewFrame {
 public:
  struct Content {
    std::int64_t utime = 0;          ///< time stamp of the depth image [us since the epoch]
    std::int64_t number = 0;         ///< RgbdFrame::number
    FramePtr frame;                  ///< null: there are no images
    std::optional<ViewFocus> focus;  ///< none: no hand has a pose
    FrameVector<ViewMessage> messages;
    std::array<ViewSkinPtr, 2> skins;          ///< skins of the hands, by Handedness; null: no such hand
    std::vector<ros::HandState> hands;         ///< the hands' messages, not encoded, for viewers of ROS messages
    std::vector<object_state_t> objects = {};  ///< messages about objects, not encoded, likewise
    std::optional<health_t> health;            ///< counters of the pipeline; none: it is not their time
    std::optional<SE3> T_world_camera;         ///< none: the pose of the camera in the room is unknown
    std::optional<LogPlace> place = {};        ///< none: no log is played
    ColouredDepths depths = {};                ///< range of the picture of depth
  };
  explicit ViewFrame(Content content) : content_(std::move(content)) {}
  const Content& content() const { return content_; }

  /// Appends the chunks 'F' (header), 'T' (place in the log) and 'L' (messages) to `out`. `now`: time of sending [us
  /// since the epoch].
  void write_states(std::int64_t now, std::vector<std::uint8_t>& out) const;
  /// The chunk 'D': the depth image on a grid of at most kMaxPoints points; empty without images. ViewCloud::hand: only
  /// the part in focus, or all of it if there is no focus.
  std::span<const std::uint8_t> cloud(ViewCloud kind) const;
  /// The chunk 'P': a JPEG that is at most kLargeWidth or kSmallWidth pixels wide; empty without such an image.
  std::span<const std::uint8_t> picture(ViewPicture kind, bool large) const;

  static constexpr int kMaxPoints = 20'000, kLargeWidth = 640, kSmallWidth = 320;

 private:
  /// A chunk that is made on first use.
  struct Made {
    std::once_flag flag;
    std::vector<std::uint8_t> bytes;
  };
  Content content_;
  mutable Made scene_cloud_, hand_cloud_;
  mutable std::array<std::array<Made, 2>, 2> pictures_;  // [0: colour, 1: depth][0: small, 1: large]
};
using ViewFramePtr = std::shared_ptr<const ViewFrame>;

}  // namespace barehand
