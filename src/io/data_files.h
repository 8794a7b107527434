#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Folders with the shipped files (configs/ ...), in the order in which they are searched: the one that belongs to the
/// installed program, then the source tree from which it was built.
std::vector<std::string> data_directories();

/// Path of a shipped file, for example "configs/default.yaml".
Result<std::string> find_data_file(const std::string& name);

/// Path of the configuration that a user gives as --config: a path, or the bare name of a shipped configuration
/// ("paper", "paper.yaml").
Result<std::string> find_config(const std::string& name);

}  // namespace barehand
