#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "math/se3.h"

namespace barehand {

/// Where the camera stands in the room, as a user states it. The world frame is the user's: any origin and heading, in
/// metres, right-handed, with z against gravity. docs/frames_and_units.md explains how to find the numbers.
struct CameraPlacement {
  /// Position x, y, z [m] and quaternion x, y, z, w of the camera in the world; or the 4x4 matrix, row by row. It maps
  /// camera coordinates to world coordinates. The default, the identity, means that the placement is not known.
  std::vector<double> T_world_camera = {0, 0, 0, 0, 0, 0, 1};
};

template <class V>
void visit(V& v, CameraPlacement& p) {
  v.user("T_world_camera", p.T_world_camera, -1000.0, 1000.0,
         "pose of the camera in the room, whose z axis points up: x, y, z [m] and the quaternion x, y, z, w, or a 4x4 "
         "matrix row by row; the default: not known");
}

/// The pose of the camera in the world; none: it is not known. Errors, which name `where`: neither 7 nor 16 numbers, a
/// number that is not finite, a quaternion whose norm is not 1, a matrix that is not a right-handed rigid motion.
Result<std::optional<SE3>> world_from(const CameraPlacement& placement,
                                      const std::string& where = "world.T_world_camera");

}  // namespace barehand
