#include "drivers/synthetic/hand/triangle_mesh.h"

namespace barehand::synthetic {

void TriangleMesh::append(const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  for (const Triangle& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace barehand::synthetic
