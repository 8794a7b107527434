#pragma once

#include <array>

#include "math/se3.h"
#include "object/object_mesh.h"

namespace barehand {

/// The half turns about the three principal axes of a surface, through its centroid: T_object_object, in the object's
/// frame. They are the turns that change the surface least if it is nearly symmetric. Of a surface with equal moments,
/// such as a box with square ends, the axes are those of its frame where these fit. The surface must have an area.
std::array<SE3, 3> half_turns(const ObjectMesh& mesh);

}  // namespace barehand
