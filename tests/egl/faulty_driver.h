#pragma once

#include <atomic>
#include <condition_variable>
#include <cstring>
#include <future>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "observe/egl/egl_functions.h"
#include "observe/egl/gl_functions.h"

namespace barehand {

/// A layer above the real driver: counts the calls of its functions, and lets them fail if a test wants it. Only one
/// object may exist at a time, since EGL's functions have no argument for it.
class FaultyDriver {
 public:
  FaultyDriver() { current_ = this; }
  ~FaultyDriver() { current_ = nullptr; }
  FaultyDriver(const FaultyDriver&) = delete;
  FaultyDriver& operator=(const FaultyDriver&) = delete;

  std::atomic<bool> stays_mapped = true;    ///< GL_EXT_buffer_storage is supported
  std::atomic<GLenum> error = GL_NO_ERROR;  ///< result of glGetError() from now on
  std::atomic<GLenum> reset = GL_NO_ERROR;  ///< result of glGetGraphicsResetStatus()
  std::atomic<bool> fences_hang = false;    ///< the device never finishes its work
  std::atomic<bool> mapping_fails = false;
  std::atomic<bool> dispatch_blocks = false;  ///< glDispatchCompute() does not return before let_go()
  std::atomic<int> made_current = 0, released = 0, threads_released = 0, dispatched = 0, buffers_made = 0;

  void let_go() { gate_.set_value(); }
  /// Waits until the thread that used the context has released it.
  void wait_for_thread_release() {
    std::unique_lock lock(mutex_);
    thread_released_.wait(lock, [&] { return threads_released > 0; });
  }
  std::set<std::thread::id> threads() {
    const std::lock_guard lock(mutex_);
    return threads_;
  }

  static Result<Egl> load() {
    auto egl = load_egl("libEGL.so.1");
    if (!egl) return egl;
    real_ = *egl;

    // Count the calls that make a context current or release it.
    egl->MakeCurrent = [](EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
      current_->meet();
      ++(context == EGL_NO_CONTEXT ? current_->released : current_->made_current);
      return real_.MakeCurrent(display, draw, read, context);
    };

    egl->ReleaseThread = [] {
      const EGLBoolean done = real_.ReleaseThread();
      const std::lock_guard lock(current_->mutex_);
      ++current_->threads_released;
      current_->thread_released_.notify_all();
      return done;
    };

    // Replace the functions of OpenGL ES, too, which are looked up by name.
    egl->GetProcAddress = find;
    return egl;
  }

 private:
  using Function = __eglMustCastToProperFunctionPointerType;

  static Function find(const char* name) {
    const Function real = real_.GetProcAddress(name);
    const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
    if (is("glGetString")) return keep(real, real_gl_.GetString, get_string);
    if (is("glGetError")) return keep(real, real_gl_.GetError, get_error);
    if (is("glGetGraphicsResetStatusEXT") || is("glGetGraphicsResetStatusKHR"))
      return keep(real, real_gl_.GetGraphicsResetStatus, get_reset);
    if (is("glClientWaitSync")) return keep(real, real_gl_.ClientWaitSync, wait_for_fence);
    if (is("glDispatchCompute")) return keep(real, real_gl_.DispatchCompute, dispatch);
    if (is("glGenBuffers")) return keep(real, real_gl_.GenBuffers, generate);
    if (is("glMapBufferRange")) return keep(real, real_gl_.MapBufferRange, map);
    return real;
  }
  template <class Pointer>
  static Function keep(Function real, Pointer& kept, Pointer instead) {
    kept = reinterpret_cast<Pointer>(real);
    return reinterpret_cast<Function>(instead);
  }

  static const GLubyte* get_string(GLenum name) {
    const GLubyte* text = real_gl_.GetString(name);
    if (name != GL_EXTENSIONS || current_->stays_mapped) return text;
    return reinterpret_cast<const GLubyte*>("GL_EXT_robustness");
  }
  static GLenum get_error() {
    const GLenum real = real_gl_.GetError();
    return current_->error != GL_NO_ERROR ? current_->error.load() : real;
  }
  static GLenum get_reset() { return current_->reset; }
  static GLenum wait_for_fence(GLsync fence, GLbitfield flags, GLuint64 limit) {
    return current_->fences_hang ? GL_TIMEOUT_EXPIRED : real_gl_.ClientWaitSync(fence, flags, limit);
  }
  static void dispatch(GLuint x, GLuint y, GLuint z) {
    current_->meet();
    ++current_->dispatched;
    if (current_->dispatch_blocks) current_->opened_.wait();
    real_gl_.DispatchCompute(x, y, z);
  }
  static void generate(GLsizei count, GLuint* names) {
    current_->buffers_made += count;
    real_gl_.GenBuffers(count, names);
  }
  static void* map(GLenum target, GLintptr offset, GLsizeiptr length, GLbitfield access) {
    return current_->mapping_fails ? nullptr : real_gl_.MapBufferRange(target, offset, length, access);
  }

  void meet() {
    const std::lock_guard lock(mutex_);
    threads_.insert(std::this_thread::get_id());
  }

  static inline FaultyDriver* current_ = nullptr;
  static inline Egl real_;
  static inline Gl real_gl_;
  std::promise<void> gate_;
  std::shared_future<void> opened_ = gate_.get_future();
  std::mutex mutex_;
  std::condition_variable thread_released_;
  std::set<std::thread::id> threads_;
};

}  // namespace barehand
