#include "drivers/synthetic/grasped_object.h"

#include <limits>
#include <utility>

namespace barehand::synthetic {

// The truth about contacts between a simulated hand and the object that it grasps.

GraspedObject::GraspedObject(std::string name, TriangleMesh mesh)
    : name_(std::move(name)), mesh_(std::move(mesh)), distance_(mesh_.vertices, mesh_.triangles) {}

HandContacts GraspedObject::contacts(std::span<const Eigen::Vector3f> skin, std::span<const std::uint8_t> segments,
                                     const SE3& T_camera_object) const {
  // Find the vertex of every segment that is nearest, or deepest inside.
  const SE3 T_object_camera = T_camera_object.inverse();
  std::array<double, kSegmentCount> least;
  least.fill(std::numeric_limits<double>::max());
  std::array<Eigen::Vector3d, kSegmentCount> nearest{};

  // Compare the signed distances of all vertices.
  for (std::size_t v = 0; v < skin.size(); ++v) {
    const Eigen::Vector3d p = T_object_camera * skin[v].cast<double>();
    const double distance = distance_.signed_distance(p);
    if (distance >= least[segments[v]]) continue;
    least[segments[v]] = distance;
    nearest[segments[v]] = p;
  }

  // Add the place on the object and its smooth normal.
  HandContacts contacts;
  for (int s = 0; s < kSegmentCount; ++s) {
    const MeshDistance::Nearest place = distance_.nearest(nearest[s]);

    // Interpolate the normals of the triangle's corners.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      normal += place.weights[k] * mesh_.normals[mesh_.triangles[place.triangle][k]].cast<double>();
    contacts[s] = {least[s], T_camera_object * place.point, T_camera_object.R * normal.normalized()};
  }
  return contacts;
}

}  // namespace barehand::synthetic
