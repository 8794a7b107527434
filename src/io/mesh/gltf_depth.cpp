// Measures how deeply the JSON of a glTF file is nested.
#include "io/mesh/gltf_depth.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>

#include "io/file_ending.h"

namespace barehand {

int gltf_depth(const std::string& path) {
  // In a binary file, the JSON is the first chunk. The chunk begins with its length and its type.
  constexpr std::streamoff kHeader = 12;

  // Find out from the ending whether the file is text or binary.
  const std::string ending = lower_case_ending(path);
  const bool text = ending == ".gltf";
  if (!text && ending != ".glb") return 0;

  // Open the file, and read the length of the JSON in a binary file.
  std::ifstream file(path, std::ios::binary);
  std::uint32_t left = std::numeric_limits<std::uint32_t>::max();
  if (!text) file.seekg(kHeader).read(reinterpret_cast<char*>(&left), sizeof left);

  // Count the open brackets. Those in strings are text.
  int depth = 0, deepest = 0;
  bool in_string = false, escaped = false;
  for (std::istreambuf_iterator<char> at(file), end; at != end && left > 0; ++at, --left) {
    const char c = *at;

    // Within a string, look for its end only; a backslash escapes the character that follows.
    if (in_string) {
      if (!escaped && c == '"') in_string = false;
      escaped = !escaped && c == '\\';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace barehand
