// Draws tracked hands over the images of a frame.
#include "io/overlay/overlay_drawing.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "core/format.h"
#include "hand/status_name.h"
#include "io/overlay/finger_colours.h"
#include "io/overlay/overlay_view.h"
#include "io/overlay/segment_labels.h"
#include "io/overlay/skin_layer.h"

namespace barehand {
namespace {

constexpr int kSmallWidth = 480;       // frames narrower than this are enlarged [px]
constexpr double kDepthAround = 0.15;  // the colours show depths up to this far in front of and behind the hand [m]
const cv::Scalar kDistalBlue(40, 80, 255), kWhite(255, 255, 255);

/// Draws the bones and the distal ends of a hand's segments onto an image, with thin lines that hide little of the
/// skin.
class BoneDrawing {
 public:
  BoneDrawing(cv::Mat picture, const Intrinsics& camera, int scale, const HandEstimate& estimate)
      : picture_(std::move(picture)), camera_(camera), scale_(scale), estimate_(estimate) {}

  void draw() {
    for (int finger = 0; finger < kFingerCount; ++finger)
      draw_bone(kPalm, proximal_end_of(estimate_, kPalm), proximal_end_of(estimate_, segment_of(finger, 0)));
    for (int s = 1; s < kSegmentCount; ++s) draw_bone(s, proximal_end_of(estimate_, s), distal_end_of(estimate_, s));
    for (int s = 1; s < kSegmentCount; ++s) draw_distal_end(s);
  }

 private:
  /// Draws a bone from `a` to `b` in the colour of its finger, lighter if the segment was measured in this frame.
  void draw_bone(int s, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const auto from = pixel_of(camera_, a), to = pixel_of(camera_, b);
    if (!from || !to) return;
    const Rgb c = finger_colour(s);
    const double whiteness = is_measured(estimate_, s) ? 0.6 : 0;
    const cv::Scalar colour = (1 - whiteness) * cv::Scalar(c.r, c.g, c.b) + whiteness * kWhite;
    cv::line(picture_, *from, *to, colour, 1, cv::LINE_AA, kFractionBits);
  }
  void draw_distal_end(int s) {
    const auto centre = pixel_of(camera_, distal_end_of(estimate_, s));
    if (!centre) return;
    const bool measured = is_measured(estimate_, s);
    const int radius = (scale_ + 1) << kFractionBits;
    if (measured) cv::circle(picture_, *centre, radius, kDistalBlue, cv::FILLED, cv::LINE_AA, kFractionBits);
    cv::circle(picture_, *centre, radius, measured ? kWhite : kDistalBlue, 1, cv::LINE_AA, kFractionBits);
  }

  cv::Mat picture_;
  const Intrinsics& camera_;
  int scale_;
  const HandEstimate& estimate_;
};

Image<Rgb> grey_depth_picture(const RgbdFrame& frame, const ColouredDepths& range) {
  Image<Rgb> picture(frame.depth.width(), frame.depth.height());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (frame.depth[i] == 0) continue;
    const double near = (range.far - frame.depth[i] * frame.depth_unit) / (range.far - range.near);
    const auto grey = static_cast<std::uint8_t>(40 + 180 * std::clamp(near, 0.0, 1.0));
    picture[i] = {grey, grey, grey};
  }
  return picture;
}

struct Caption {
  std::string text;
  cv::Scalar colour;
};

Caption caption_of(const RgbdFrame& frame, double seconds, std::span<const DrawnHand> hands) {
  const std::array<cv::Scalar, 4> kColour = {cv::Scalar(170, 170, 170), {90, 220, 90}, {255, 180, 60}, {255, 80, 80}};
  Caption caption{formatted("frame %lld   %.3f s", static_cast<long long>(frame.number), seconds), kColour[0]};
  for (const auto& [e, skin] : hands) {
    caption.text += "   " + std::string(to_string(e.status));
    if (e.has_pose() || hands.size() > 1) caption.text += "   " + std::string(to_string(e.handedness)) + " hand";
    if (e.has_pose()) caption.text += formatted("   mismatch %.1f mm", e.score * 1000);
    if (&e == &hands[0].estimate || e.has_pose()) caption.colour = kColour[static_cast<std::size_t>(e.status)];
  }
  return caption;
}

/// A view of the image: drawing into it draws into the image. Channels are R, G, B.
cv::Mat view(Image<Rgb>& image) { return {image.height(), image.width(), CV_8UC3, image.data()}; }

}  // namespace

std::optional<ColouredDepths> depths_around(std::span<const DrawnHand> hands) {
  std::optional<ColouredDepths> range;
  for (const DrawnHand& hand : hands) {
    if (!hand.estimate.has_pose()) continue;
    const double z = hand.estimate.segments[segment_of(2, 0)].T_camera_segment.t.z();
    const ColouredDepths own{z - kDepthAround, z + kDepthAround};
    range = range ? ColouredDepths{std::min(range->near, own.near), std::max(range->far, own.far)} : own;
  }
  return range;
}

int overlay_scale(const Intrinsics& camera) { return camera.width < kSmallWidth ? 2 : 1; }

Image<Rgb> draw_overlay(const RgbdFrame& frame, double seconds, std::span<const DrawnHand> hands,
                        const OverlayDepths& depths, SegmentNames names) {
  // Prepare the output image, its two halves and the skin that is painted over both.
  const int scale = overlay_scale(frame.camera);
  const Intrinsics camera = enlarged(frame.camera, scale);
  Image<Rgb> sheet(2 * camera.width, camera.height + kCaptionHeight);
  Image<Rgb> colour = frame.colour.empty() ? grey_depth_picture(frame, depths.left) : frame.colour;
  Image<Rgb> depth = depth_colours(frame, depths.right);
  const SkinLayer skin = render_skin(frame, scale, hands);

  // Draw colour on the left and depth on the right.
  for (Image<Rgb>* picture : {&colour, &depth}) {
    cv::Mat part = view(sheet)(cv::Rect(picture == &colour ? 0 : camera.width, 0, camera.width, camera.height));
    cv::resize(view(*picture), part, part.size(), 0, 0, cv::INTER_NEAREST);
    paint_skin(skin, part);

    // Draw the bones over the skin, and the names in the colour picture only.
    for (const DrawnHand& hand : hands) {
      if (!hand.estimate.has_pose()) continue;
      BoneDrawing(part, camera, scale, hand.estimate).draw();
      if (names == SegmentNames::drawn && picture == &colour) draw_segment_names(hand.estimate, camera, part);
    }
  }

  // Write the caption below both halves.
  const Caption caption = caption_of(frame, seconds, hands);
  cv::putText(view(sheet), caption.text, {8, camera.height + 19}, cv::FONT_HERSHEY_SIMPLEX, 0.5, caption.colour, 1,
              cv::LINE_AA);
  return sheet;
}

}  // namespace barehand
