#pragma once

#include <span>
#include <vector>

#include "core/image.h"
#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "math/camera.h"

namespace barehand {

/// A point of skin in the camera frame [m] with its outward unit normal.
struct OrientedPoint {
  Eigen::Vector3d p, n;
};

/// Chooses points of a hand that the camera sees. Reuses its memory.
class VisiblePoints {
 public:
  /// At most `count` points of the posed surface that the camera sees (facing it and not behind another part of the
  /// hand), spread evenly over the image: each represents about the same number of pixels. The choice is deterministic.
  /// The points are valid until the next call.
  std::span<const OrientedPoint> of(const HandSurface& surface, const HandPose& pose, const Intrinsics& camera,
                                    int count);

 private:
  struct Facing {
    OrientedPoint point;
    double weight;  // number of pixels that the point covers, up to a constant factor
  };
  void find_facing(const HandSurface& surface, const HandPose& pose);
  void remove_hidden(const Intrinsics& camera);

  std::vector<Facing> facing_;
  Image<float> front_;  // depth of the front-most point in every coarse cell (z-buffer) [m]
  std::vector<OrientedPoint> chosen_;
};

}  // namespace barehand
