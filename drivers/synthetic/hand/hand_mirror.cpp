#include "drivers/synthetic/hand/hand_mirror.h"

#include <utility>

namespace barehand::synthetic {

HandMesh mirrored(const HandMesh& mesh) {
  HandMesh other = mesh;
  other.handedness = opposite(mesh.handedness);
  for (SE3& T : other.T_hand_joint) T = mirrored(T);
  for (auto& v : other.vertices) v.x() = -v.x();
  for (Triangle& t : other.triangles) std::swap(t[1], t[2]);
  return other;
}

}  // namespace barehand::synthetic
