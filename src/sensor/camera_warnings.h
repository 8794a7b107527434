#pragma once

#include <string>
#include <vector>

#include "math/camera.h"

namespace barehand {

/// Warnings about intrinsics that are possible but unlikely, as sentences with the likely cause: a field of view that
/// hardly any camera has, a principal point far from the image centre, intrinsics of another image size. Empty if
/// nothing looks wrong.
std::vector<std::string> camera_warnings(const Intrinsics& camera);

}  // namespace barehand
