#pragma once

#include <optional>
#include <span>

#include "core/image.h"
#include "hand/hand_pose.h"
#include "hand/skin.h"
#include "io/overlay/colour_map.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

// Draws tracked hands over the images of a frame.

/// Height of the caption below the images [px].
inline constexpr int kCaptionHeight = 28;
/// The factor by which small frames are enlarged, so that lines stay legible.
int overlay_scale(const Intrinsics& camera);

/// A hand to be drawn: its estimate, and the skin of its profile.
struct DrawnHand {
  const HandEstimate& estimate;
  const Skin& skin;
};

/// Whether an overlay names the segments.
enum class SegmentNames { left_out, drawn };

/// The depths that an overlay colours: those of the left image, where there is no colour, and those of the right one.
struct OverlayDepths {
  ColouredDepths left, right;
};
/// The range of depths around the hands; none: no hand has a pose.
std::optional<ColouredDepths> depths_around(std::span<const DrawnHand> hands);

/// Draws the colour and the depth image side by side, and the hands over both: the translucent, shaded skin in one
/// colour for each finger (paint_skin), then thin bones and the distal ends of the segments as blue dots (paper Fig.
/// 8), hollow if the segment is inferred. Names of segments are written over the colour image only. The caption below
/// states frame number, `seconds` since the first frame and the status of each hand. Without a pose, only images and
/// caption are drawn.
Image<Rgb> draw_overlay(const RgbdFrame& frame, double seconds, std::span<const DrawnHand> hands,
                        const OverlayDepths& depths, SegmentNames names = SegmentNames::left_out);

}  // namespace barehand
