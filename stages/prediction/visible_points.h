#pragma once

#include <vector>

#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "math/camera.h"

namespace barehand {

/// A point of skin in the camera frame [m] with its outward unit normal.
struct OrientedPoint {
  Eigen::Vector3d p, n;
};

/// At most `count` points of the posed surface that the camera sees (facing it and not behind another part of the
/// hand), spread evenly over the image: each stands for about the same number of pixels. Deterministic.
std::vector<OrientedPoint> visible_points(const HandSurface& surface, const HandPose& pose, const Intrinsics& camera,
                                          int count);

}  // namespace barehand
