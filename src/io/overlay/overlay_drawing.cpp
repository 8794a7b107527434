#include "io/overlay/overlay_drawing.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/format.h"
#include "hand/status_name.h"
#include "io/overlay/colour_map.h"

namespace barehand {
namespace {

constexpr int kSmallWidth = 480;       // narrower frames are enlarged
constexpr double kDepthAround = 0.12;  // depth in front of and behind the hand that the colours show [m]
constexpr int kShift = 4;              // fractional bits of drawing coordinates
const cv::Scalar kDistalBlue(40, 80, 255), kWhite(255, 255, 255);
const cv::Scalar kPalmColour(210, 210, 210);
const std::array<cv::Scalar, kFingerCount> kFingerColours = {
    cv::Scalar(235, 70, 60), {245, 175, 40}, {80, 205, 80}, {40, 195, 220}, {215, 95, 225}};

cv::Scalar colour_of(int segment) { return segment == kPalm ? kPalmColour : kFingerColours[finger_of(segment)]; }

/// Draws one hand onto one image of the frame.
class HandDrawing {
 public:
  HandDrawing(cv::Mat picture, const Intrinsics& camera, int scale, const HandEstimate& estimate,
              const HandSurface& surface)
      : picture_(std::move(picture)), camera_(camera), scale_(scale), estimate_(estimate), surface_(surface) {}

  void draw() {
    for (int s : far_to_near()) draw_skin(s);
    for (int finger = 0; finger < kFingerCount; ++finger)
      draw_line(origin(kPalm), origin(segment_of(finger, 0)), kPalmColour, solid(kPalm) ? 2 : 1);
    for (int s : far_to_near())
      if (s != kPalm) draw_line(origin(s), distal(s), colour_of(s), solid(s) ? 3 : 1);
    for (int s = 1; s < kSegmentCount; ++s) draw_distal_end(s);
  }

 private:
  using Pixel = std::optional<cv::Point>;  // with kShift fractional bits; empty: behind the camera or far outside

  bool solid(int s) const { return estimate_.status == TrackStatus::tracking && estimate_.segments[s].seen; }
  const SE3& pose(int s) const { return estimate_.segments[s].T_camera_segment; }
  Eigen::Vector3d origin(int s) const { return pose(s).t; }
  Eigen::Vector3d distal(int s) const { return pose(s) * estimate_.profile->segments[s].distal; }

  std::array<int, kSegmentCount> far_to_near() const {
    std::array<int, kSegmentCount> order;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [this](int a, int b) { return origin(a).z() + distal(a).z() > origin(b).z() + distal(b).z(); });
    return order;
  }
  Pixel project(const Eigen::Vector3d& p) const {
    constexpr double kFar = 1e5;  // keeps the fixed-point coordinates within 32 bits
    if (!(p.z() > 0.01)) return {};
    // Pixel centres lie at integers: enlarging keeps the edges of pixels in place, not their centres.
    const Eigen::Vector2d pixel = (camera_.project(p).array() + 0.5) * scale_ - 0.5;
    if (!(pixel.cwiseAbs().maxCoeff() < kFar)) return {};
    return cv::Point(cvRound(pixel.x() * (1 << kShift)), cvRound(pixel.y() * (1 << kShift)));
  }
  /// The skin of one segment is convex, so the hull of its points is its outline.
  std::vector<cv::Point> outline(int s) const {
    const SegmentSurface& skin = surface_[s];
    std::vector<cv::Point> points, hull;
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Pixel pixel = project(pose(s) * Eigen::Vector3d(skin.x[i], skin.y[i], skin.z[i]));
      if (!pixel) return {};
      points.push_back(*pixel);
    }
    if (points.size() >= 3) cv::convexHull(points, hull);
    return hull;
  }
  void draw_skin(int s) {
    const std::vector<cv::Point> hull = outline(s);
    if (hull.size() < 3) return;
    if (solid(s)) {
      cv::Mat filled = picture_.clone();
      cv::fillConvexPoly(filled, hull, colour_of(s), cv::LINE_AA, kShift);
      const double opacity = 0.06 + 0.3 * std::clamp(estimate_.segments[s].confidence, 0.0, 1.0);
      cv::addWeighted(filled, opacity, picture_, 1 - opacity, 0, picture_);
    }
    cv::polylines(picture_, hull, true, colour_of(s), 1, cv::LINE_AA, kShift);
  }
  void draw_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const cv::Scalar& colour, int thickness) {
    const Pixel from = project(a), to = project(b);
    if (from && to) cv::line(picture_, *from, *to, colour, thickness, cv::LINE_AA, kShift);
  }
  void draw_distal_end(int s) {
    const Pixel centre = project(distal(s));
    if (!centre) return;
    const int radius = (scale_ + 2) << kShift;
    if (solid(s)) cv::circle(picture_, *centre, radius, kDistalBlue, cv::FILLED, cv::LINE_AA, kShift);
    cv::circle(picture_, *centre, radius, solid(s) ? kWhite : kDistalBlue, 1, cv::LINE_AA, kShift);
  }

  cv::Mat picture_;
  const Intrinsics& camera_;
  int scale_;
  const HandEstimate& estimate_;
  const HandSurface& surface_;
};

Image<Rgb> grey_depth_picture(const RgbdFrame& frame) {
  const ColouredDepths range = typical_range(frame);
  Image<Rgb> picture(frame.depth.width(), frame.depth.height());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (frame.depth[i] == 0) continue;
    const double near = (range.far - frame.depth[i] * frame.depth_unit) / (range.far - range.near);
    const auto grey = static_cast<std::uint8_t>(40 + 180 * std::clamp(near, 0.0, 1.0));
    picture[i] = {grey, grey, grey};
  }
  return picture;
}

ColouredDepths shown_range(const RgbdFrame& frame, std::span<const DrawnHand> hands) {
  ColouredDepths range{INFINITY, -INFINITY};
  for (const DrawnHand& hand : hands) {
    if (!hand.estimate.has_pose()) continue;
    const double z = hand.estimate.segments[segment_of(2, 0)].T_camera_segment.t.z();
    range = {std::min(range.near, z - kDepthAround), std::max(range.far, z + kDepthAround)};
  }
  return range.near < range.far ? range : typical_range(frame);
}

struct Caption {
  std::string text;
  cv::Scalar colour;
};

Caption caption_of(const RgbdFrame& frame, std::span<const DrawnHand> hands) {
  const std::array<cv::Scalar, 4> kColour = {cv::Scalar(170, 170, 170), {90, 220, 90}, {255, 180, 60}, {255, 80, 80}};
  Caption caption{
      formatted("frame %lld   %.3f s", static_cast<long long>(frame.number), static_cast<double>(frame.utime) * 1e-6),
      kColour[0]};
  for (const auto& [e, surface] : hands) {
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

int overlay_scale(const Intrinsics& camera) { return camera.width < kSmallWidth ? 2 : 1; }

Image<Rgb> draw_overlay(const RgbdFrame& frame, std::span<const DrawnHand> hands) {
  const int scale = overlay_scale(frame.camera);
  const int width = frame.depth.width() * scale, height = frame.depth.height() * scale;
  Image<Rgb> sheet(2 * width, height + kCaptionHeight);
  Image<Rgb> colour = frame.colour.empty() ? grey_depth_picture(frame) : frame.colour;
  Image<Rgb> depth = depth_colours(frame, shown_range(frame, hands));
  int left = 0;
  for (Image<Rgb>* picture : {&colour, &depth}) {
    cv::Mat part = view(sheet)(cv::Rect(left, 0, width, height));
    cv::resize(view(*picture), part, part.size(), 0, 0, cv::INTER_NEAREST);
    for (const auto& [estimate, surface] : hands)
      if (estimate.has_pose()) HandDrawing(part, frame.camera, scale, estimate, surface).draw();
    left += width;
  }
  const Caption caption = caption_of(frame, hands);
  cv::putText(view(sheet), caption.text, {8, height + 19}, cv::FONT_HERSHEY_SIMPLEX, 0.5, caption.colour, 1,
              cv::LINE_AA);
  return sheet;
}

}  // namespace barehand
