#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "hand/rendering/hand_renderer.h"
#include "observe/detection.h"
#include "support/adult_hand.h"
#include "support/scene.h"

namespace barehand::test {

/// A depth image of a person in front of a wall: a box for the body, a capsule for the forearm, and a hand. Lengths are
/// in metres, positions in the camera frame.
class RenderedPerson {
 public:
  explicit RenderedPerson(const Intrinsics& camera, double wall = 1.6) : camera_(camera) {
    depth_.reset(camera.width, camera.height, static_cast<float>(wall));
    is_hand_.reset(camera.width, camera.height, 0);
  }

  /// Adds the front of an upright box that faces the camera, with its middle at (x, y, z).
  RenderedPerson& box(double x, double y, double z, double width, double height) {
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) {
        const Eigen::Vector3d p = camera_.unproject(u, v, z);
        if (std::abs(p.x() - x) < width / 2 && std::abs(p.y() - y) < height / 2) put(u, v, z, false);
      }
    return *this;
  }

  /// Adds a capsule between the points `a` and `b`.
  RenderedPerson& capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius) {
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) put(u, v, capsule_depth(camera_, u, v, a, b, radius), false);
    return *this;
  }

  /// Adds a hand, and a forearm from its wrist to an elbow.
  RenderedPerson& hand(const HandProfile& profile, const HandPose& pose, const Eigen::Vector3d& elbow) {
    capsule(pose[kPalm].t + 0.02 * (elbow - pose[kPalm].t).normalized(), elbow, 0.028);
    RenderedHand rendered;
    render_hand(make_blended_skin(profile, 0.004), pose, camera_, {0, 0, 1, camera_.width, camera_.height}, rendered);
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) put(u, v, rendered.depth.at(u, v), true);
    return *this;
  }

  std::shared_ptr<RgbdFrame> frame() const {
    auto frame = std::make_shared<RgbdFrame>();
    frame->camera = camera_;
    frame->depth.reset(camera_.width, camera_.height);
    for (std::size_t i = 0; i < depth_.size(); ++i)
      frame->depth[i] = static_cast<std::uint16_t>(std::lround(depth_[i] / frame->depth_unit));
    return frame;
  }
  bool is_hand(int u, int v) const { return is_hand_.at(u, v) != 0; }

 private:
  void put(int u, int v, double z, bool hand) {
    if (z <= 0 || z >= depth_.at(u, v)) return;
    depth_.at(u, v) = static_cast<float>(z);
    is_hand_.at(u, v) = hand;
  }

  Intrinsics camera_;
  Image<float> depth_;
  Image<std::uint8_t> is_hand_;
};

inline Intrinsics vga_camera() { return {640, 480, 525, 525, 319.5, 239.5}; }

/// The landmarks of a pose in the camera frame [m].
inline std::array<Eigen::Vector3d, kLandmarkCount> landmarks(const HandProfile& profile, const HandPose& pose) {
  std::array<Eigen::Vector3d, kLandmarkCount> points;
  points[kWristLandmark] = pose[kPalm].t;
  for (int finger = 0; finger < kFingerCount; ++finger) {
    for (int k = 0; k < 3; ++k) points[landmark_of(finger, k)] = pose[segment_of(finger, k)].t;
    points[landmark_of(finger, 3)] = distal_end(profile, pose, segment_of(finger, 2));
  }
  return points;
}

/// A hand as the networks detect it: its joints with a standard deviation of `deviation` [m], all labels hand.
inline DetectedHand detected_hand(const HandProfile& profile, const HandPose& pose, double right_log_odds,
                                  double deviation = 0.005, double hand_log_odds = 6) {
  DetectedHand hand;
  const auto joints = landmarks(profile, pose);
  for (int k = 0; k < kLandmarkCount; ++k)
    hand.joints[k] = {joints[k], deviation * deviation * Eigen::Matrix3d::Identity()};
  hand.centre = 0.5 * (joints[kWristLandmark] + joints[kMiddleKnuckleLandmark]);
  hand.palm = 0.9;
  hand.hand_log_odds = hand_log_odds;
  hand.right_log_odds = right_log_odds;
  hand.side = profile.handedness;
  hand.labels.label.reset(1, 1, SurfaceLabel::hand);
  hand.labels.hand_log_odds.reset(1, 1, 6.f);
  return hand;
}

}  // namespace barehand::test
