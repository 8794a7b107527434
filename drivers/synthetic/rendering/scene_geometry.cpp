#include "drivers/synthetic/rendering/scene_geometry.h"

#include <utility>

namespace barehand::synthetic {

// Collects the triangles of all objects of a scene in the camera frame.

void SceneGeometry::add(const TriangleMesh& mesh, const SE3& T_camera_mesh, std::uint8_t surface_index) {
  const Eigen::Matrix3f R = T_camera_mesh.R.cast<float>();
  const Eigen::Vector3f t = T_camera_mesh.t.cast<float>();
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const auto& v : mesh.vertices) vertices.push_back(R * v + t);
  for (const auto& n : mesh.normals) normals.push_back(R * n);
  for (const Triangle& c : mesh.triangles) triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
  surface.insert(surface.end(), mesh.triangles.size(), surface_index);
}

void SceneGeometry::add(const SceneGeometry& other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  for (const Triangle& c : other.triangles) triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
  surface.insert(surface.end(), other.surface.begin(), other.surface.end());
}

void SceneGeometry::mirror() {
  for (auto& v : vertices) v.x() = -v.x();
  for (auto& n : normals) n.x() = -n.x();
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

}  // namespace barehand::synthetic
