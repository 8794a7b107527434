#pragma once

#include <optional>
#include <vector>

#include "drivers/synthetic/people/staged_sequence.h"
#include "math/random.h"

namespace barehand::synthetic {

/// The lines on a desk that tall objects must leave free: from the hand above the desk to the shoulder, and from the
/// hand to the camera. (x, y) in the world frame; the desk's top is at z = 0.
struct FreeLines {
  Eigen::Vector2d hand, shoulder, camera;
};

/// A desk between the edges `near_y` and `far_y` (world frame), with a keyboard, a book and, away from the `free`
/// lines, mugs, boxes and cylinders.
std::vector<PlacedObject> make_desk(double near_y, double far_y, const std::optional<FreeLines>& free,
                                    KeyedRandom& random);

/// A wall in the plane at y, and a floor in the plane at z. World frame.
PlacedObject make_wall(double y);
PlacedObject make_floor(double z);

}  // namespace barehand::synthetic
