#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/memory/frame_memory.h"
#include "observe/detection.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// What a pixel of the region of interest shows. Missing depth is unknown, not background.
enum class PixelLabel : std::uint8_t { unknown = 0, background = 1, hand = 2, object = 3 };

/// A preprocessed frame, the input of the trackers: labelled depth and derived maps within the region of interest
/// around one hand. Pixel (u, v) of the maps is pixel (u + u0, v + v0) of the frame. Camera frame, metres. Immutable
/// once shared.
struct HandObservation {
  FramePtr frame;
  bool hand_present = false;  ///< false: no hand-like data in this frame; the maps may be empty
  /// Whether the hand was found where the tracker predicted it; if not, it may be any hand-like region of the frame.
  bool followed = false;
  int u0 = 0, v0 = 0;  ///< top-left corner of the region of interest in the frame
  Image<float> depth;  ///< z [m]; 0 = no measurement
  Image<PixelLabel> label;
  Image<Eigen::Vector3f> normal;     ///< unit normals of hand pixels, towards the camera; zero where undefined
  Image<std::int32_t> nearest_hand;  ///< index of the nearest hand pixel in the image plane (paper Sec. 4.1); -1: none
  Image<std::int32_t> nearest_object;               ///< index of the nearest object pixel; -1: none
  std::vector<std::int32_t> hand_pixels;            ///< indices of the hand pixels
  std::vector<Eigen::Vector3f> cloud;               ///< hand points for ICP, evenly subsampled
  std::shared_ptr<const DetectedHand> detected;     ///< the detection of this hand; null if there is none
  std::shared_ptr<const DetectedHand> second_look;  ///< Detection::second_look of this hand; null if there is none
  double noise = 0.001;                             ///< 1-sigma axial noise of this sensor at the hand's distance [m]

  /// The 3D point of pixel (u, v), or of the pixel with index i, in the camera frame [m]; zero without measurement.
  Eigen::Vector3f point(int u, int v) const {
    const Intrinsics& c = frame->camera;
    const float z = depth.at(u, v);
    return {static_cast<float>((u + u0 - c.cx) / c.fx) * z, static_cast<float>((v + v0 - c.cy) / c.fy) * z, z};
  }
  Eigen::Vector3f point(std::int32_t i) const { return point(i % depth.width(), i / depth.width()); }
};
using HandObservationPtr = std::shared_ptr<const HandObservation>;
/// One observation per configured hand, always in the same order.
using HandObservations = FrameVector<HandObservationPtr>;

}  // namespace barehand
