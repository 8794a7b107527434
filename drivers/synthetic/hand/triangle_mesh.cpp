#include "drivers/synthetic/hand/triangle_mesh.h"

#include <utility>

namespace barehand::synthetic {

void TriangleMesh::append(const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  for (const Triangle& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

TriangleMesh mirrored(const TriangleMesh& mesh) {
  TriangleMesh other = mesh;
  for (auto& v : other.vertices) v.x() = -v.x();
  for (auto& n : other.normals) n.x() = -n.x();
  for (Triangle& t : other.triangles) std::swap(t[1], t[2]);
  return other;
}

}  // namespace barehand::synthetic
