#pragma once

#include <vector>

#include "drivers/synthetic/hand/triangle_mesh.h"
#include "sensor/rgbd_frame.h"

namespace barehand::synthetic {

// The triangles of a simulated scene, and their surfaces.

/// The appearance of a surface.
struct Material {
  Rgb colour;
  double gloss = 0;  ///< glossiness in [0, 1]; structured-light cameras lose pixels of glossy surfaces that face them
};

inline constexpr Rgb kSkinColour = {214, 162, 134}, kClothColour = {42, 66, 138};

/// All triangles of one image in the camera frame, and the surface that each of them belongs to.
struct SceneGeometry {
  std::vector<Eigen::Vector3f> vertices, normals;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> surface;  ///< surface of every triangle, which is also the index of its material

  /// Appends a mesh, all of whose triangles get the surface `surface_index`.
  void add(const TriangleMesh& mesh, const SE3& T_camera_mesh, std::uint8_t surface_index);
  /// Appends another scene with its surfaces.
  void add(const SceneGeometry& other);
  /// Mirrors everything in the plane x = 0, which turns a right hand into a left one.
  void mirror();
};

}  // namespace barehand::synthetic
