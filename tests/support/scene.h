#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "hand/profile.h"
#include "observe/observation.h"

namespace barehand {

/// A camera with a small image around the optical axis. At 0.4 m, a pixel is 0.8 mm wide.
inline Intrinsics small_camera(int width = 96, int height = 96) {
  return {width, height, 525, 525, (width - 1) / 2.0, (height - 1) / 2.0};
}

/// Depth and label of one pixel.
struct ScenePixel {
  float depth = 0;  ///< depth of the pixel [m]; 0: no depth
  PixelLabel label = PixelLabel::background;
};

/// Index of the nearest hand pixel, found by a search in growing squares; -1: there is none.
inline std::int32_t nearest_in(const Image<PixelLabel>& label, int u, int v) {
  std::int32_t nearest = -1;
  int best = std::numeric_limits<int>::max();
  for (int r = 0; r <= std::max(label.width(), label.height()) && r * r <= best; ++r)
    for (int j = v - r; j <= v + r; ++j)
      for (int i = u - r; i <= u + r; i += std::abs(j - v) == r ? 1 : std::max(1, 2 * r)) {
        const int d = (i - u) * (i - u) + (j - v) * (j - v);
        if (!label.contains(i, j) || label.at(i, j) != PixelLabel::hand || d >= best) continue;
        best = d;
        nearest = static_cast<std::int32_t>(label.index(i, j));
      }
  return nearest;
}

/// Makes an observation whose region of interest is the whole image, from a function that gives the pixel at (u, v).
/// The nearest hand pixels are exact.
inline HandObservation make_observation(const Intrinsics& camera, const std::function<ScenePixel(int, int)>& scene) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = camera;
  HandObservation o;
  o.frame = frame;
  o.depth.reset(camera.width, camera.height);
  o.label.reset(camera.width, camera.height, PixelLabel::background);
  o.nearest_hand.reset(camera.width, camera.height, -1);

  // Ask the scene for every pixel.
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const ScenePixel pixel = scene(u, v);
      o.depth.at(u, v) = pixel.depth;
      o.label.at(u, v) = pixel.label;
      if (pixel.label == PixelLabel::hand) o.hand_pixels.push_back(static_cast<std::int32_t>(o.depth.index(u, v)));
    }

  // Compute the distance transform.
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) o.nearest_hand.at(u, v) = nearest_in(o.label, u, v);
  o.hand_present = !o.hand_pixels.empty();
  return o;
}

/// Depth z at pixel (u, v) of a capsule between a and b (camera frame), found by sphere tracing [m]; 0: the ray misses
/// the capsule.
inline float capsule_depth(const Intrinsics& camera, int u, int v, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           double radius) {
  const Eigen::Vector3d ray = camera.unproject(u, v, 1).normalized();
  double travelled = 0;
  for (int step = 0; step < 100 && travelled < 2; ++step) {
    const Eigen::Vector3d p = travelled * ray;
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double distance = (p - a - t * (b - a)).norm() - radius;
    if (distance < 1e-6) return static_cast<float>(p.z());
    travelled += distance;
  }
  return 0;
}

/// A profile whose segments all are capsules like the rendered one: bones of 30 mm with a radius of 8 mm.
inline HandProfile capsule_profile() {
  HandProfile profile;
  for (SegmentProfile& s : profile.segments) {
    s.length = 0.03;
    s.distal = {0, 0, -0.03};
    s.radius = s.half_width = s.half_thickness = {0.008, 0.008};
  }
  return profile;
}

/// T_camera_segment of a bone at the depth `z` [m] that points up in the image, with its back towards the camera.
inline SE3 upright_pose(double z = 0.4) {
  SE3 T;
  T.R.col(0) = Eigen::Vector3d(1, 0, 0);
  T.R.col(1) = Eigen::Vector3d(0, 0, -1);
  T.R.col(2) = Eigen::Vector3d(0, 1, 0);
  T.t = {0, 0.015, z};
  return T;
}

/// The pixel at (u, v) of a scene with one segment's capsule at upright_pose(), before a background at 1 m.
inline ScenePixel upright_capsule(const Intrinsics& camera, int u, int v) {
  const SE3 T = upright_pose();
  const float z = capsule_depth(camera, u, v, T.t, T * Eigen::Vector3d(0, 0, -0.03), 0.008);
  return z > 0 ? ScenePixel{z, PixelLabel::hand} : ScenePixel{1.0f, PixelLabel::background};
}

}  // namespace barehand
