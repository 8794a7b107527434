#pragma once

#include <string>
#include <string_view>

namespace barehand {

inline constexpr const char* kEglLibrary = "libEGL.so.1";

/// What OpenGL ES runs on.
struct GraphicsDevice {
  std::string renderer;   ///< as the driver calls it: "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;    ///< "OpenGL ES 3.2 Mesa 22.3.6"
  bool software = false;  ///< computed on the CPU
};

enum class DeviceChoice {
  hardware,  ///< a GPU or nothing
  any,       ///< a GPU where there is one, else software
};

/// Whether a GL_RENDERER string names a renderer that runs on the CPU.
bool is_software_renderer(std::string_view renderer);

}  // namespace barehand
