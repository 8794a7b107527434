#include "io/hand/path_of_hand.h"

#include <filesystem>

namespace barehand {

std::string path_of_hand(const std::string& path, int k, Handedness side) {
  if (k == 0) return path;
  const std::filesystem::path whole(path);
  return whole.parent_path() /
         (whole.stem().string() + "_" + std::string(to_string(side)) + whole.extension().string());
}

}  // namespace barehand
