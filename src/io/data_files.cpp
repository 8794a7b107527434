// Finds the shipped files (configurations, hands, networks) of an installed program or a source tree.
#include "io/data_files.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace barehand {

std::vector<std::string> data_directories() {
  std::vector<std::string> directories;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) directories.push_back((program.parent_path().parent_path() / BAREHAND_DATA_DIR).lexically_normal());
  directories.push_back(BAREHAND_SOURCE_DIR);
  return directories;
}

Result<std::string> find_data_file(const std::string& name) {
  std::string searched;
  for (const std::string& directory : data_directories()) {
    const std::string path = directory + "/" + name;
    std::error_code error;
    if (fs::exists(path, error)) return path;
    searched += (searched.empty() ? "" : ", ") + directory;
  }
  return fail("no such file in " + searched, name, "install Barehand again, or run it from its source tree");
}

Result<std::string> find_config(const std::string& name) {
  std::error_code error;
  if (fs::exists(name, error) && !fs::is_directory(name, error)) return name;
  if (name.find('/') == std::string::npos) {
    const std::string file = name.ends_with(".yaml") ? name : name + ".yaml";
    if (auto shipped = find_data_file("configs/" + file)) return shipped;
  }
  return fail("no such configuration", name, "give a file, or one of paper.yaml, default.yaml, accurate.yaml");
}

}  // namespace barehand
