#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "observe/egl/egl_functions.h"
#include "observe/egl/gl_functions.h"
#include "observe/egl/graphics_device.h"

namespace barehand {

/// An OpenGL ES 3.1 context without window or screen. It is made current once, on the thread that opens it, and stays
/// current until it is destroyed there, because with some drivers making it current takes tens of milliseconds. The
/// destructor also releases EGL's data of that thread, which would be freed twice if the thread ended while the process
/// does.
class HeadlessContext {
 public:
  /// Opens a context on the first device of this choice that works. Error: there is none.
  static Result<std::unique_ptr<HeadlessContext>> open(const Egl& egl, DeviceChoice choice);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  const GraphicsDevice& device() const { return device_; }
  const Gl& gl() const { return gl_; }

 private:
  HeadlessContext(const Egl& egl, EGLDisplay display, EGLContext context)
      : egl_(egl), display_(display), context_(context) {}
  static Result<std::unique_ptr<HeadlessContext>> open_on(const Egl& egl, EGLDisplay display);
  Result<void> make_current();

  Egl egl_;
  EGLDisplay display_;  // never terminated, because other parts of the process may use it
  EGLContext context_;
  Gl gl_;
  GraphicsDevice device_;
};

}  // namespace barehand
