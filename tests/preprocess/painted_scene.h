#pragma once

#include <cmath>
#include <memory>

#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "sensor/rgbd_frame.h"

namespace barehand::test {

inline constexpr Rgb kSkin{205, 150, 120}, kGreen{60, 160, 70}, kBlue{40, 60, 140}, kGrey{120, 120, 120}, kBlack{};

/// A frame with flat patches that face the camera. Their coordinates are in the camera frame [m].
class PaintedScene {
 public:
  explicit PaintedScene(float wall = 1.2f, Rgb wall_colour = kGrey) {
    frame_.camera = {320, 240, 240.0, 240.0, 159.5, 119.5};
    frame_.depth_unit = 1e-4;
    frame_.depth.reset(320, 240, counts(wall));
    frame_.colour.reset(320, 240, wall_colour);
  }
  PaintedScene& patch(double x0, double y0, double x1, double y1, double z, Rgb colour) {
    const Intrinsics& c = frame_.camera;
    for (int v = 0; v < c.height; ++v)
      for (int u = 0; u < c.width; ++u) {
        const Eigen::Vector3d p = c.unproject(u, v, z);
        if (p.x() < x0 || p.x() > x1 || p.y() < y0 || p.y() > y1) continue;
        frame_.depth.at(u, v) = counts(z);
        frame_.colour.at(u, v) = colour;
      }
    return *this;
  }
  /// Adds an open right hand with the fingers up and the wrist at (x, y, z): a palm of 80 x 90 mm, four fingers of 90
  /// mm, and the thumb on the right.
  PaintedScene& hand(double x, double y, double z, Rgb colour = kSkin) {
    patch(x - 0.04, y - 0.09, x + 0.04, y, z, colour);
    for (int finger = 0; finger < 4; ++finger) {
      const double centre = x + 0.0315 - 0.021 * finger;
      patch(centre - 0.008, y - 0.18, centre + 0.008, y - 0.09, z, colour);
    }
    return patch(x + 0.04, y - 0.055, x + 0.085, y - 0.035, z, colour);
  }
  /// Adds a forearm of 54 mm width, from the wrist down to the border of the image.
  PaintedScene& forearm(double x, double y, double z, Rgb colour) {
    return patch(x - 0.027, y, x + 0.027, y + 1, z, colour);
  }
  PaintedScene& no_colour() {
    frame_.colour.reset(0, 0);
    return *this;
  }
  PaintedScene& erase_depth(int u0, int v0, int u1, int v1) {
    for (int v = v0; v < v1; ++v)
      for (int u = u0; u < u1; ++u) frame_.depth.at(u, v) = 0;
    return *this;
  }
  RgbdFrame& frame() { return frame_; }
  FramePtr share(std::int64_t number = 0) const {
    auto copy = std::make_shared<RgbdFrame>(frame_);
    copy->number = number;
    copy->utime = 1'000'000 + number * 33'333;
    return copy;
  }

 private:
  std::uint16_t counts(double z) const { return static_cast<std::uint16_t>(std::lround(z / 1e-4)); }
  RgbdFrame frame_;
};

/// The exact estimate of the hand that PaintedScene::hand() adds.
inline HandEstimate painted_hand_estimate(double x, double y, double z, std::int64_t number = 0) {
  auto profile = std::make_shared<HandProfile>();
  HandEstimate estimate;
  estimate.number = number;
  estimate.utime = 1'000'000 + number * 33'333;
  estimate.status = TrackStatus::tracking;

  // Place a segment relative to the wrist.
  Eigen::Matrix3d up;  // -z of the segment = up in the image = -y of the camera
  up << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const auto place = [&](int segment, double dx, double dy, double length, double radius, const Eigen::Matrix3d& R) {
    estimate.segments[segment].T_camera_segment = {R, {x + dx, y + dy, z + 0.01}};
    profile->segments[segment].distal = {0, 0, -length};
    profile->segments[segment].length = length;
    profile->segments[segment].radius = {radius, radius};
  };

  // Place the palm, the fingers upwards and the thumb to the side.
  place(kPalm, 0, 0, 0.09, 0.02, up);
  for (int finger = 1; finger < kFingerCount; ++finger)
    for (int k = 0; k < 3; ++k)
      place(segment_of(finger, k), 0.0315 - 0.021 * (finger - 1), -0.09 - 0.03 * k, k == 2 ? 0.022 : 0.03, 0.008, up);

  Eigen::Matrix3d right;  // -z of the segment = +x of the camera
  right << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  for (int k = 0; k < 3; ++k) place(segment_of(0, k), 0.02 + 0.02 * k, -0.045, 0.02, 0.01, right);
  estimate.profile = profile;
  return estimate;
}

/// The label at the projection of a point in the camera frame [m].
inline PixelLabel label_at(const HandObservation& o, double x, double y, double z) {
  const Eigen::Vector2d p = o.frame->camera.project({x, y, z});
  const int u = static_cast<int>(std::lround(p.x())) - o.u0, v = static_cast<int>(std::lround(p.y())) - o.v0;
  return o.label.contains(u, v) ? o.label.at(u, v) : PixelLabel::unknown;
}

}  // namespace barehand::test
