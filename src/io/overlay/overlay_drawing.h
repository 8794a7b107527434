#pragma once

#include <span>

#include "core/image.h"
#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Pixels of the caption below the pictures.
inline constexpr int kCaptionHeight = 28;
/// Small frames are enlarged by this factor, so that lines stay legible.
int overlay_scale(const Intrinsics& camera);

struct DrawnHand {
  const HandEstimate& estimate;
  const HandSurface& surface;  ///< skin to outline
};

/// Colour and depth side by side with the hands drawn over both: bones in one colour per finger, the outline of the
/// skin filled the more the higher the confidence, distal ends as blue dots (paper Fig. 8). Segments that are inferred
/// stay hollow. Below: frame number, time, status of each. Without a pose only pictures and caption.
Image<Rgb> draw_overlay(const RgbdFrame& frame, std::span<const DrawnHand> hands);

}  // namespace barehand
