#pragma once

#include <string>
#include <vector>

#include "math/camera.h"

namespace barehand {

/// What looks wrong about intrinsics that are possible, in sentences with the likely cause: a field of view that hardly
/// any camera has, a principal point far from the middle, intrinsics of another image size. Empty: nothing.
std::vector<std::string> camera_doubts(const Intrinsics& camera);

}  // namespace barehand
