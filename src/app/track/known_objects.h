#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "core/log.h"
#include "object/known_object.h"

namespace barehand {

/// Reads and prepares the meshes of known objects, whose ids are 1, 2 and so on. `units`: none (metres), one for all or
/// one for each. Logs the size of each object and what was repaired.
Result<std::vector<KnownObjectPtr>> load_objects(const std::vector<std::string>& paths,
                                                 const std::vector<std::string>& units, spdlog::logger& log);

}  // namespace barehand
