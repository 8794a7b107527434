#pragma once

#include "drivers/synthetic/hand/triangle_mesh.h"

namespace barehand::synthetic {

/// A tube around the forearm from just behind the wrist to the elbow, in the camera frame. It starts in the direction
/// of the palm and bends towards the elbow. `bare`: a forearm without a sleeve, which is as thin as the wrist.
TriangleMesh make_sleeve(const SE3& T_camera_palm, const Eigen::Vector3d& elbow, double hand_scale, bool bare);

}  // namespace barehand::synthetic
