#include "drivers/synthetic/hand/hand_mesh_file.h"

#include <cstdlib>
#include <filesystem>

namespace barehand::synthetic {

// Finds the files of the hand meshes, which are fetched separately.

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

std::string hand_mesh_folder(const std::string& configured) {
  if (!configured.empty()) return configured;
  if (const std::string folder = environment("BAREHAND_HANDS"); !folder.empty()) return folder;
  std::string cache = environment("XDG_CACHE_HOME");
  if (cache.empty()) cache = environment("HOME") + "/.cache";
  return cache + "/barehand/hands";
}

Result<std::string> find_hand_mesh(Handedness handedness, const std::string& configured) {
  const std::string path = hand_mesh_folder(configured) + "/" + std::string(to_string(handedness)) + ".glb";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    return fail("the simulator's hand mesh is missing", path,
                "run deploy/fetch_hand_mesh.sh (installed in /usr/share/barehand) once, or set BAREHAND_HANDS to the "
                "folder that holds left.glb and right.glb");
  return path;
}

}  // namespace barehand::synthetic
