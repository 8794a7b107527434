#include "observe/egl/egl_functions.h"

#include <dlfcn.h>

#include <algorithm>
#include <sstream>

namespace barehand {

// Loads EGL at run time, and lists the displays on which OpenGL ES may run.

namespace {

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

template <class Function>
void find_extension(const Egl& egl, const char* name, Function& function) {
  function = reinterpret_cast<Function>(egl.GetProcAddress(name));
}

}  // namespace

Result<Egl> load_egl(const std::string& library) {
  const std::string remedy = "sudo apt-get install libegl1 libgl1-mesa-dri";

  // EGL is never unloaded, because drivers leave threads and thread-local data behind.
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!handle) return fail("EGL cannot be loaded: " + std::string(dlerror()), library, remedy);

  // Find the functions that every version of EGL has.
  Egl egl{};
  const bool complete =
      find(handle, "eglBindAPI", egl.BindAPI) && find(handle, "eglCreateContext", egl.CreateContext) &&
      find(handle, "eglDestroyContext", egl.DestroyContext) && find(handle, "eglGetDisplay", egl.GetDisplay) &&
      find(handle, "eglGetError", egl.GetError) && find(handle, "eglGetProcAddress", egl.GetProcAddress) &&
      find(handle, "eglInitialize", egl.Initialize) && find(handle, "eglMakeCurrent", egl.MakeCurrent) &&
      find(handle, "eglQueryString", egl.QueryString) && find(handle, "eglReleaseThread", egl.ReleaseThread);

  // Close the handle; the library remains loaded.
  dlclose(handle);
  if (!complete) return fail("not an EGL library", library, remedy);

  // Check whether the library can enumerate devices.
  const char* extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool enumerates =
      has_extension(extensions, "EGL_EXT_device_base") ||
      (has_extension(extensions, "EGL_EXT_device_enumeration") && has_extension(extensions, "EGL_EXT_device_query"));

  // Find the functions that enumerate devices.
  if (enumerates && has_extension(extensions, "EGL_EXT_platform_device")) {
    find_extension(egl, "eglGetPlatformDisplayEXT", egl.GetPlatformDisplayEXT);
    find_extension(egl, "eglQueryDevicesEXT", egl.QueryDevicesEXT);
    find_extension(egl, "eglQueryDeviceStringEXT", egl.QueryDeviceStringEXT);
  }
  return egl;
}

bool has_extension(const char* list, const std::string& name) {
  std::istringstream names(list ? list : "");
  for (std::string word; names >> word;)
    if (word == name) return true;
  return false;
}

std::vector<EGLDisplay> find_displays(const Egl& egl, bool with_software) {
  if (!egl.QueryDevicesEXT || !egl.GetPlatformDisplayEXT || !egl.QueryDeviceStringEXT)
    return {egl.GetDisplay(EGL_DEFAULT_DISPLAY)};
  EGLint count = 0;
  egl.QueryDevicesEXT(0, nullptr, &count);
  std::vector<EGLDeviceEXT> devices(count);
  egl.QueryDevicesEXT(count, devices.data(), &count);
  devices.resize(count);

  // Sort hardware first, so that the first display that works is the preferred one.
  const auto hardware_end = std::stable_partition(devices.begin(), devices.end(), [&](EGLDeviceEXT device) {
    return !has_extension(egl.QueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
  });
  if (!with_software) devices.erase(hardware_end, devices.end());
  std::vector<EGLDisplay> displays;
  for (EGLDeviceEXT device : devices)
    displays.push_back(egl.GetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  return displays;
}

}  // namespace barehand
