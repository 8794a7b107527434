#pragma once

#include "drivers/synthetic/triangle_mesh.h"

namespace barehand::synthetic {

/// Tube around the forearm from just behind the wrist to the elbow, bending from the palm's direction to the elbow's;
/// in the frame of `T_camera_palm`'s target. `bare`: a forearm without cloth, as thin as the wrist.
TriangleMesh make_sleeve(const SE3& T_camera_palm, const Eigen::Vector3d& elbow, double hand_scale, bool bare);

}  // namespace barehand::synthetic
