#pragma once

#include "object/known_object.h"
#include "observe/observation.h"
#include "observe/surface_point.h"
#include "support/solid_meshes.h"

namespace barehand::test {

/// A box with a knob on its right side, above the middle.
inline ObjectMesh box_with_knob() {
  ObjectMesh mesh = box_mesh({0.06f, 0.12f, 0.03f});
  mesh.name = "box with a knob";
  add(mesh, box_mesh({0.03f, 0.03f, 0.03f}), {0.04f, 0.035f, 0});
  return mesh;
}

/// A pose of it before the camera, tilted a little. From column kKnob on, a hand hides the knob, so that nothing shows
/// whether it is above or below.
inline SE3 knob_right(double tilt, bool above) {
  return {exp_so3({0.2, tilt, 0}) * exp_so3({above ? std::numbers::pi : 0, 0, 0}), {0, 0.005, 0.5}};
}
constexpr int kKnob = 110;

/// An ideal camera that sees one object before a wall; a hand may cover part of the image.
struct ObjectScene {
  static constexpr double kWall = 0.9;  // distance of the wall [m]
  Intrinsics camera{200, 150, 330, 330, 99.5, 74.5};
  const KnownObject* object = nullptr;  ///< null: only the wall
  SE3 T_camera_object;
  int covered_from = 200;  ///< first column that a hand covers, which is nearer than everything

  /// Depth of the object at a pixel [m], found by sphere tracing; 0: the ray misses it.
  double depth(int u, int v) const {
    if (!object) return 0;
    const Eigen::Vector3d ray = camera.unproject(u, v, 1).normalized();
    const SE3 T_object_camera = T_camera_object.inverse();
    double along = T_camera_object.t.norm() - 2 * object->radius;
    for (int step = 0; step < 100 && along < kWall; ++step) {
      const double distance = object->grid.distance((T_object_camera * Eigen::Vector3d(along * ray)).cast<float>());
      if (distance < 1e-4) return along * ray.z();
      along += 0.9 * distance;
    }
    return 0;
  }

  HandObservationPtr observe(std::int64_t utime) const {
    auto frame = std::make_shared<RgbdFrame>();
    frame->utime = utime;
    frame->camera = camera;
    frame->depth_unit = 1e-4;
    frame->depth.reset(camera.width, camera.height, 0);

    // Cover the right part of the image by a hand; elsewhere the object and the wall are seen.
    auto seen = std::make_shared<HandObservation>();
    seen->hand_present = true;
    seen->depth.reset(camera.width, camera.height);
    seen->label.reset(camera.width, camera.height, PixelLabel::background);
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const double z = depth(u, v);
        const bool hand = u >= covered_from;
        seen->depth.at(u, v) = static_cast<float>(hand ? 0.3 : z > 0 ? z : kWall);
        if (hand || z > 0) seen->label.at(u, v) = hand ? PixelLabel::hand : PixelLabel::object;
        frame->depth.at(u, v) = static_cast<std::uint16_t>(seen->depth.at(u, v) / frame->depth_unit);
      }

    seen->frame = frame;
    return seen;
  }

  /// The points of everything nearer than the wall that is no hand's, as one thing with the id 7.
  static std::vector<SurfacePoint> points(const HandObservation& seen) {
    std::vector<SurfacePoint> points;
    for (int v = 0; v < seen.depth.height(); v += 2)
      for (int u = 0; u < seen.depth.width(); u += 2)
        if (seen.label.at(u, v) == PixelLabel::object) points.push_back({seen.point(u, v), {0, 0, -1}, 0, 7});
    return points;
  }
};

}  // namespace barehand::test
