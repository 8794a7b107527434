#include "observe/egl/graphics_device.h"

#include <gmock/gmock.h>

#include "observe/egl/egl_functions.h"

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

TEST(GraphicsDevice, AbsentEglIsAnErrorThatSaysWhatToInstall) {
  const auto device = find_graphics_device(DeviceChoice::any, "libnone.so.1");
  ASSERT_FALSE(device);
  EXPECT_THAT(device.error().message(), ::testing::HasSubstr("libnone.so.1"));
  EXPECT_THAT(device.error().remedy, ::testing::HasSubstr("libegl1"));
}

TEST(GraphicsDevice, AnyDeviceComesWithItsName) {
  const auto device = find_graphics_device(DeviceChoice::any);
  ASSERT_TRUE(device) << device.error().message();
  EXPECT_FALSE(device->renderer.empty());
  EXPECT_THAT(device->version, ::testing::HasSubstr("OpenGL ES 3"));
}

// What EGL keeps for a thread is freed twice if the thread ends while the process does.
TEST(GraphicsDevice, NothingOfEglStaysWithTheThreadThatLooked) {
  const auto egl = load_egl(kEglLibrary);
  ASSERT_TRUE(egl);
  const auto bound = reinterpret_cast<PFNEGLQUERYAPIPROC>(egl->GetProcAddress("eglQueryAPI"));
  for (const auto choice : {DeviceChoice::hardware, DeviceChoice::any}) {
    ASSERT_TRUE(egl->BindAPI(EGL_OPENGL_API));
    find_graphics_device(choice);
    EXPECT_EQ(bound(), static_cast<EGLenum>(EGL_OPENGL_ES_API)) << "as on a new thread";
  }
}

}  // namespace
}  // namespace barehand
