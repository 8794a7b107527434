#pragma once

#include <vector>

#include "drivers/synthetic/hand_mesh.h"

namespace barehand::synthetic {

/// A rigid thing's surface in its own frame [m]. Normals are outward, one a vertex; edges that shall look sharp have
/// their vertices twice.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Triangle> triangles;

  void append(const TriangleMesh& other);
};

}  // namespace barehand::synthetic
