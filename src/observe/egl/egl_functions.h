#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// The functions of EGL that are used. They are loaded at run time, so that Barehand also runs on machines without EGL.
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
  /// Functions of EGL_EXT_platform_base, EGL_EXT_device_enumeration and EGL_EXT_device_query; all null if an extension
  /// is missing.
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplayEXT = nullptr;
  PFNEGLQUERYDEVICESEXTPROC QueryDevicesEXT = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceStringEXT = nullptr;
};

/// Loads EGL, which stays loaded until the process ends. `library`: file name as for dlopen.
Result<Egl> load_egl(const std::string& library);

/// Whether a blank-separated list of extensions (may be null) contains `name`.
bool has_extension(const char* list, const std::string& name);

/// One display per device, hardware first, software devices only if asked for; the default display (EGL_PLATFORM
/// decides what that is) where devices cannot be listed.
std::vector<EGLDisplay> find_displays(const Egl& egl, bool with_software);

}  // namespace barehand
