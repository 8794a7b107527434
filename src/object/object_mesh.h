#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/error.h"
#include "math/mesh_distance.h"

namespace barehand {

/// The surface of an object in its own frame [m]. Triangles are counter-clockwise seen from outside.
struct ObjectMesh {
  std::string name;
  std::vector<Eigen::Vector3f> vertices;
  std::vector<MeshDistance::Triangle> triangles;
};

/// The box that encloses all vertices of a mesh, which must not be empty.
Eigen::AlignedBox3f bounding_box(const ObjectMesh& mesh);

/// What repair_mesh() had to change.
struct MeshRepair {
  std::size_t merged = 0;   ///< vertices that coincided with another one
  std::size_t removed = 0;  ///< triangles without area, or given twice
  std::size_t flipped = 0;  ///< triangles that faced inwards
  std::size_t closed = 0;   ///< holes that were closed
};

/// Makes a mesh the closed surface of a solid: merges vertices, turns the triangles outwards and closes holes narrower
/// than a quarter of the object. Parts may overlap. Errors name what cannot be repaired: wide openings, edges where
/// surfaces branch, surfaces with one side only, and sheets that enclose nothing. `where` names the mesh in them.
Result<MeshRepair> repair_mesh(ObjectMesh& mesh, const std::string& where);

}  // namespace barehand
