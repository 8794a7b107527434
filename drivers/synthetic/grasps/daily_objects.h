#pragma once

#include <string>
#include <vector>

#include "drivers/synthetic/grasps/hold.h"
#include "drivers/synthetic/rendering/scene_geometry.h"

namespace barehand::synthetic {

/// An object of daily life: a closed mesh in its own frame and the parts by which it can be held.
struct DailyObject {
  std::string name;
  TriangleMesh mesh;
  Material material;
  std::vector<Hold> holds;
};

/// Names of all objects; those for testing are never drawn for training, see docs/simulator.md.
std::vector<std::string> object_names(bool for_testing);
/// Whether there is an object with this name.
bool is_object(const std::string& name);
/// Makes an object, `size` times as large as usual. The name must be one of object_names().
DailyObject make_object(const std::string& name, double size);

}  // namespace barehand::synthetic
