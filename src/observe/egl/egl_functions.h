#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// The functions of EGL that are in use, loaded at run time: where there is no EGL, Barehand runs all the same.
struct Egl {
  PFNEGLBINDAPIPROC BindAPI;
  PFNEGLCREATECONTEXTPROC CreateContext;
  PFNEGLDESTROYCONTEXTPROC DestroyContext;
  PFNEGLGETDISPLAYPROC GetDisplay;
  PFNEGLGETERRORPROC GetError;
  PFNEGLGETPROCADDRESSPROC GetProcAddress;
  PFNEGLINITIALIZEPROC Initialize;
  PFNEGLMAKECURRENTPROC MakeCurrent;
  PFNEGLQUERYSTRINGPROC QueryString;
  PFNEGLRELEASETHREADPROC ReleaseThread;
  /// Of EGL_EXT_platform_base, EGL_EXT_device_enumeration and EGL_EXT_device_query; null where one is missing.
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplayEXT = nullptr;
  PFNEGLQUERYDEVICESEXTPROC QueryDevicesEXT = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceStringEXT = nullptr;
};

/// `library`: file name as for dlopen. It stays loaded until the process ends.
Result<Egl> load_egl(const std::string& library);

/// Whether a blank-separated list of extensions (may be null) has this one.
bool has_extension(const char* list, const std::string& name);

/// One display per device, hardware first, software devices only if asked for; the default display (EGL_PLATFORM
/// decides what that is) where devices cannot be listed.
std::vector<EGLDisplay> find_displays(const Egl& egl, bool with_software);

}  // namespace barehand
