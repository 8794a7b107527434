#pragma once

#include <vector>

#include "math/se3.h"

namespace barehand::synthetic {

/// The shape of the part of an object by which fingers hold it.
enum class HoldKind {
  rod,   ///< a round bar along x
  slab,  ///< two parallel faces, perpendicular to y
  ball,  ///< round in all directions
};

/// A part of an object by which it can be held. In the frame of the hold, x is the axis of a rod, and y is the
/// direction in which thumb and fingers oppose each other.
struct Hold {
  HoldKind kind = HoldKind::ball;
  SE3 T_object_hold;
  double width = 0;   ///< extent along y [m]
  double length = 0;  ///< for a rod or slab: largest extent perpendicular to y [m]
};

}  // namespace barehand::synthetic
