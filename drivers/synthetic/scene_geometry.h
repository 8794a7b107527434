#pragma once

#include <vector>

#include "drivers/synthetic/triangle_mesh.h"
#include "math/frame.h"

namespace barehand::synthetic {

/// How a surface looks.
struct Material {
  Rgb colour;
  double gloss = 0;  ///< [0, 1]: how much of a mirror it is; range cameras lose glossy surfaces that face them
};

/// All triangles of one frame in the camera frame, with what each belongs to.
struct SceneGeometry {
  std::vector<Eigen::Vector3f> vertices, normals;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> surface;  ///< of every triangle: index into the materials

  void add(const TriangleMesh& mesh, const SE3& T_camera_mesh, std::uint8_t surface_index);
  void add(const SceneGeometry& other);
  /// Reflects everything in the plane x = 0: a scene of the other hand.
  void mirror();
};

}  // namespace barehand::synthetic
