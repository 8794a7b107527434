#pragma once

#include <optional>
#include <vector>

#include "drivers/synthetic/people/staged_sequence.h"
#include "math/random.h"

namespace barehand::synthetic {

/// The lines on a desk that tall things leave free: from the hand above it to the shoulder and to the camera, (x, y) in
/// the world frame; the desk's top is at z = 0.
struct FreeLines {
  Eigen::Vector2d hand, shoulder, camera;
};

/// A desk between the edges `near_y` and `far_y`, with a keyboard, a book and, where `free` does not forbid it,
/// mugs, boxes and cylinders.
std::vector<PlacedObject> make_desk(double near_y, double far_y, const std::optional<FreeLines>& free,
                                    KeyedRandom& random);

/// A wall at the distance y, and a floor at the height z. World frame.
PlacedObject make_wall(double y);
PlacedObject make_floor(double z);

}  // namespace barehand::synthetic
