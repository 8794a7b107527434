#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "core/log.h"
#include "object/known_object.h"

namespace CLI {
class App;
}

namespace barehand {

/// The meshes of the objects that the hand may hold, as `--object` and `--object-unit` name them.
struct ObjectMeshes {
  std::vector<std::string> paths;
  std::vector<std::string> units;  ///< of the files: none (metres), one for all, or one for each
};
void add_object_options(CLI::App& command, ObjectMeshes& files);

/// Reads and prepares the meshes of known objects, whose ids are 1, 2 and so on. Logs the size of each object and what
/// was repaired.
Result<std::vector<KnownObjectPtr>> load_objects(const ObjectMeshes& files, spdlog::logger& log);

}  // namespace barehand
