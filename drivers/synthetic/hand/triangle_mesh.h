#pragma once

#include <vector>

#include "drivers/synthetic/hand/hand_mesh.h"

namespace barehand::synthetic {

/// The surface of a rigid object in its own frame [m]. There is one outward normal per vertex; at sharp edges the
/// vertices are doubled.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Triangle> triangles;

  /// Adds the triangles of another mesh in the same frame.
  void append(const TriangleMesh& other);
};

/// The mirror image of a mesh in the plane x = 0.
TriangleMesh mirrored(const TriangleMesh& mesh);

}  // namespace barehand::synthetic
