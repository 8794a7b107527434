#pragma once

#include "drivers/synthetic/hand/triangle_mesh.h"

namespace barehand::synthetic {

/// A tube around the forearm, from just behind the wrist to the elbow, that bends from the direction of the palm to
/// that of the elbow. Camera frame. `bare`: a forearm without a sleeve, as thin as the wrist.
TriangleMesh make_sleeve(const SE3& T_camera_palm, const Eigen::Vector3d& elbow, double hand_scale, bool bare);

}  // namespace barehand::synthetic
