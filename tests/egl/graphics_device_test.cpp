#include "observe/egl/graphics_device.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(GraphicsDevice, SoftwareIsToldFromHardware) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer",
                           "zink Vulkan 1.3(llvmpipe (LLVM 15.0.6, 256 bits))",
                           "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)",
                           "D3D12 (Microsoft Basic Render Driver)"})
    EXPECT_TRUE(is_software_renderer(name)) << name;
  for (const char* name : {"NVIDIA H100 PCIe/PCIe/SSE2", "AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49)",
                           "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "Mali-G610", "V3D 7.1.7"})
    EXPECT_FALSE(is_software_renderer(name)) << name;
}

}  // namespace
}  // namespace barehand
