#include "observe/egl/graphics_device.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace barehand {

bool is_software_renderer(std::string_view renderer) {
  std::string lower(renderer);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array kNames{"llvmpipe",    "softpipe", "swrast", "software rasterizer",
                              "swiftshader", "lavapipe", "swr ",   "basic render driver"};
  return std::any_of(kNames.begin(), kNames.end(), [&](const char* name) { return lower.find(name) != lower.npos; });
}

}  // namespace barehand
