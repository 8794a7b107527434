#pragma once

#include <array>
#include <span>

#include "object/known_object.h"

namespace barehand {

/// The half turns about the three principal axes of a surface, through its middle: T_object_object, in the object's
/// frame. They are the turns that change the surface least if it is nearly symmetric.
std::array<SE3, 3> half_turns(std::span<const SurfaceSample> surface);

}  // namespace barehand
