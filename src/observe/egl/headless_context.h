#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/error.h"
#include "observe/egl/egl_functions.h"
#include "observe/egl/gl_functions.h"
#include "observe/egl/graphics_device.h"

namespace barehand {

/// An OpenGL ES 3.1 context without window or screen. It is current on a thread only while a Current lives there, so
/// any thread may use it, one at a time. Leaves nothing of EGL behind on a thread: what one keeps that ends while the
/// process does would be freed twice.
class HeadlessContext {
 public:
  static Result<std::unique_ptr<HeadlessContext>> open(DeviceChoice choice, const std::string& egl_library);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  class Current {
   public:
    explicit Current(const HeadlessContext& context) : context_(&context) {}
    Current(Current&& other) noexcept : context_(std::exchange(other.context_, nullptr)) {}
    Current& operator=(Current&&) = delete;
    ~Current();

   private:
    const HeadlessContext* context_;
  };
  /// Error: the context or its display is gone.
  Result<Current> make_current() const;

  const GraphicsDevice& device() const { return device_; }
  const Gl& gl() const { return gl_; }

 private:
  HeadlessContext(const Egl& egl, EGLDisplay display, EGLContext context)
      : egl_(egl), display_(display), context_(context) {}
  static Result<std::unique_ptr<HeadlessContext>> open_on(const Egl& egl, EGLDisplay display);
  Result<void> look_around();

  Egl egl_;
  EGLDisplay display_;  // the process's, not ours: others may use it, so it is never terminated
  EGLContext context_;
  Gl gl_;
  GraphicsDevice device_;
};

}  // namespace barehand
