#pragma once

#include <string>
#include <string_view>

namespace barehand {

inline constexpr const char* kEglLibrary = "libEGL.so.1";

/// The device that OpenGL ES runs on.
struct GraphicsDevice {
  std::string renderer;   ///< the driver's name for it, such as "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;    ///< such as "OpenGL ES 3.2 Mesa 22.3.6"
  bool software = false;  ///< whether it is a software renderer, which runs on the CPU
};

enum class DeviceChoice {
  hardware,  ///< only a GPU
  any,       ///< a GPU if there is one, else a software renderer
};

/// Whether a GL_RENDERER string names a renderer that runs on the CPU.
bool is_software_renderer(std::string_view renderer);

}  // namespace barehand
