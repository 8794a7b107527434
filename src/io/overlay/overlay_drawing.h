#pragma once

#include <span>

#include "core/image.h"
#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Height of the caption below the images [px].
inline constexpr int kCaptionHeight = 28;
/// The factor by which small frames are enlarged, so that lines stay legible.
int overlay_scale(const Intrinsics& camera);

struct DrawnHand {
  const HandEstimate& estimate;
  const HandSurface& surface;  ///< skin to outline
};

/// Draws colour and depth side by side with the hands over both: bones in one colour per finger, the outline of the
/// skin filled with an opacity that grows with the confidence, distal ends as blue dots (paper Fig. 8). Inferred
/// segments are not filled. The caption below states frame number, time and the status of each hand. Without a pose,
/// only images and caption are drawn.
Image<Rgb> draw_overlay(const RgbdFrame& frame, std::span<const DrawnHand> hands);

}  // namespace barehand
