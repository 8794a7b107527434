#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Folders that hold the shipped files (configs/ ...), in the order they are searched: beside the installed program,
/// then the source tree it was built from.
std::vector<std::string> data_directories();

/// Path of a shipped file, for example "configs/default.yaml".
Result<std::string> find_data_file(const std::string& name);

/// What a user gives as --config: a path, or the bare name of a shipped configuration ("paper", "paper.yaml").
Result<std::string> find_config(const std::string& name);

}  // namespace barehand
