#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "hand/joint_angles.h"
#include "hand/surface.h"
#include "observe/observation.h"
#include "support/adult_hand.h"

namespace barehand::test {

/// A small camera. At 0.4 m, where the hands are, a pixel is 1.7 mm wide.
inline Intrinsics small_camera() { return {320, 240, 240, 240, 159.5, 119.5}; }

/// A hand that is drawn by dense points of its skin in front of a wall at 0.9 m. Every pixel is labelled without error.
/// The hand comes out of a sleeve, which counts as background.
class PointWorld {
 public:
  enum class Arm { none, sleeve };
  explicit PointWorld(const HandProfile& profile, Arm arm = Arm::sleeve)
      : skin_(make_cylinder_surface(profile, 6000)), arm_(arm) {}

  std::shared_ptr<HandObservation> observe(const HandPose& pose, std::int64_t utime = 0) const {
    auto frame = std::make_shared<RgbdFrame>();
    frame->utime = utime;
    frame->camera = small_camera();
    auto observation = std::make_shared<HandObservation>();
    observation->frame = frame;
    observation->hand_present = true;
    observation->depth.reset(320, 240, 0.9f);
    observation->label.reset(320, 240, PixelLabel::background);
    if (arm_ == Arm::sleeve) draw_sleeve(pose[kPalm], *observation);
    draw(pose, *observation);
    finish(*observation);
    return observation;
  }

  /// Covers the columns from `u_begin` on with an object at the depth `z` [m], and removes the hand points that it
  /// hides.
  static void occlude(HandObservation& observation, int u_begin, float z) {
    for (int v = 0; v < observation.depth.height(); ++v) {
      for (int u = u_begin; u < observation.depth.width(); ++u) {
        observation.depth.at(u, v) = z;
        observation.label.at(u, v) = PixelLabel::object;
      }
    }
    observation.hand_pixels.clear(), observation.cloud.clear();
    finish(observation);
  }

 private:
  // Draws a point of the camera frame unless something nearer is in its pixel.
  static void draw_point(const Eigen::Vector3d& p, PixelLabel label, HandObservation& o) {
    const Eigen::Vector2d uv = o.frame->camera.project(p).array().round();
    const int u = static_cast<int>(uv.x()), v = static_cast<int>(uv.y());
    if (!o.depth.contains(u, v) || o.depth.at(u, v) < p.z()) return;
    o.depth.at(u, v) = static_cast<float>(p.z());
    o.label.at(u, v) = label;
  }

  static void draw_sleeve(const SE3& T_camera_palm, HandObservation& o) {
    for (int i = 0; i < 120; ++i) {
      for (int k = 0; k < 200; ++k) {
        const double angle = 2 * std::numbers::pi * k / 200;
        draw_point(T_camera_palm * Eigen::Vector3d(0.033 * std::cos(angle), 0.028 * std::sin(angle), 0.001 * i),
                   PixelLabel::background, o);
      }
    }
  }

  void draw(const HandPose& pose, HandObservation& o) const {
    for (int s = 0; s < kSegmentCount; ++s) {
      for (std::size_t i = 0; i < skin_[s].size(); ++i) {
        const Eigen::Vector3d p = pose[s] * Eigen::Vector3d(skin_[s].x[i], skin_[s].y[i], skin_[s].z[i]);
        draw_point(p, PixelLabel::hand, o);
      }
    }
  }

  static bool is_hand(const HandObservation& o, int u, int v) {
    return o.label.contains(u, v) && o.label.at(u, v) == PixelLabel::hand;
  }

  // Collects the hand's pixels and a part of their points, and computes normals away from the hand's outline.
  static void finish(HandObservation& o) {
    o.normal.reset(o.depth.width(), o.depth.height(), Eigen::Vector3f::Zero());
    for (int v = 0; v < o.depth.height(); ++v) {
      for (int u = 0; u < o.depth.width(); ++u) {
        if (!is_hand(o, u, v)) continue;
        o.hand_pixels.push_back(static_cast<std::int32_t>(o.depth.index(u, v)));
        if (o.hand_pixels.size() % 4 == 0) o.cloud.push_back(o.point(u, v));
        if (!is_hand(o, u - 2, v) || !is_hand(o, u + 2, v) || !is_hand(o, u, v - 2) || !is_hand(o, u, v + 2)) continue;
        const Eigen::Vector3f du = o.point(u + 2, v) - o.point(u - 2, v), dv = o.point(u, v + 2) - o.point(u, v - 2);
        if (du.norm() < 0.02f && dv.norm() < 0.02f) o.normal.at(u, v) = dv.cross(du).normalized();
      }
    }
  }

  HandSurface skin_;
  Arm arm_;
};

/// Mean distance between the segments' distal ends in two poses [m].
inline double mean_error(const HandProfile& profile, const HandPose& a, const HandPose& b) {
  double sum = 0;
  for (int s = 0; s < kSegmentCount; ++s) sum += (distal_end(profile, a, s) - distal_end(profile, b, s)).norm();
  return sum / kSegmentCount;
}

}  // namespace barehand::test
