#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/frame_memory.h"
#include "io/ros/ros_hand.h"
#include "io/web/view_request.h"
#include "io/web/view_skin.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// An encoded LCM message: what goes to the bus goes to the page.
struct ViewMessage {
  const char* channel = "";  ///< without a prefix: "HAND_STATE"
  FrameVector<std::uint8_t> bytes;
};

/// The part of an image that shows the hands: pixels, first column and row, and the range of depths [m].
struct ViewFocus {
  int u = 0, v = 0, width = 0, height = 0;
  double near = 0, far = 0;
};
/// Around `points` (camera frame, metres) with a margin; none if there are none in front of the camera and in view.
std::optional<ViewFocus> focus_on(std::span<const Eigen::Vector3d> points, const Intrinsics& camera);

/// Everything that the page may show of one frame. Immutable once shared. What is costly (cloud, picture) is made by
/// the first client that asks for it, on that client's thread, and never where frames are tracked.
class ViewFrame {
 public:
  struct Content {
    std::int64_t utime = 0;          ///< of the depth image [us since the epoch]
    std::int64_t number = 0;         ///< RgbdFrame::number
    FramePtr frame;                  ///< null: the images are not known
    std::optional<ViewFocus> focus;  ///< none: no hand is seen
    FrameVector<ViewMessage> messages;
    std::array<ViewSkinPtr, 2> skins;   ///< by Handedness; null: no such hand
    std::vector<ros::HandState> hands;  ///< the messages once more, for viewers of ROS
    std::optional<health_t> health;     ///< none: not due
  };
  explicit ViewFrame(Content content) : content_(std::move(content)) {}
  const Content& content() const { return content_; }

  /// Chunks 'F' and 'L', into `out`. `now`: time of sending [us since the epoch].
  void write_states(std::int64_t now, std::vector<std::uint8_t>& out) const;
  /// Chunk 'D', the depth image on a grid of at most kMaxPoints; empty without images. `hand`: what is in focus, or all
  /// of it if nothing is.
  std::span<const std::uint8_t> cloud(ViewCloud kind) const;
  /// Chunk 'P', a JPEG at most kLargeWidth or kSmallWidth pixels wide; empty without such an image.
  std::span<const std::uint8_t> picture(ViewPicture kind, bool large) const;

  static constexpr int kMaxPoints = 20'000, kLargeWidth = 640, kSmallWidth = 320;

 private:
  struct Made {
    std::once_flag flag;
    std::vector<std::uint8_t> bytes;
  };
  Content content_;
  mutable Made scene_cloud_, hand_cloud_;
  mutable std::array<std::array<Made, 2>, 2> pictures_;  // colour and depth, small and large
};
using ViewFramePtr = std::shared_ptr<const ViewFrame>;

}  // namespace barehand
