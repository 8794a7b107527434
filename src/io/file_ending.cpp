#include "io/file_ending.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace barehand {

std::string lower_case_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace barehand
