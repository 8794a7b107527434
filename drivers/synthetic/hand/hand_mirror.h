#pragma once

#include "drivers/synthetic/hand/hand_mesh.h"

namespace barehand::synthetic {

/// A point reflected in the plane x = 0.
inline Eigen::Vector3d mirrored(const Eigen::Vector3d& p) { return {-p.x(), p.y(), p.z()}; }
/// A rigid transform reflected in the plane x = 0: M T M with M = diag(-1, 1, 1).
inline SE3 mirrored(const SE3& T) {
  const Eigen::DiagonalMatrix<double, 3> M(-1, 1, 1);
  return {M * T.R * M, mirrored(T.t)};
}
/// The mesh of the same person's other hand.
HandMesh mirrored(const HandMesh& mesh);

}  // namespace barehand::synthetic
