#pragma once

#include <cstddef>
#include <vector>

#include "core/error.h"
#include "observe/egl/compare_shader.h"
#include "observe/egl/gl_functions.h"

namespace barehand {

// Buffers of the shader and the memory that a thread without the context writes and reads for it. Where the driver can
// (GL_EXT_buffer_storage), that memory is the driver's own and stays mapped. All of them only grow: a frame like the
// one before allocates nothing. What needs the context takes `Gl`; the buffers go with the context.

/// To the device. The shader reads from the device's own memory, as it does so many times.
class UploadBuffer {
 public:
  explicit UploadBuffer(ShaderBuffer binding) : binding_(binding) {}

  bool holds(std::size_t bytes) const { return bytes <= capacity_; }
  /// What is in it is lost if it grows.
  Result<void> reserve(const Gl& gl, std::size_t bytes);
  /// `capacity` bytes to write to while the device is idle.
  void* memory() { return mapped_ ? mapped_ : memory_.data(); }
  /// The first bytes of the memory go to the shader.
  void send(const Gl& gl, std::size_t bytes) const;

 private:
  ShaderBuffer binding_;
  std::size_t capacity_ = 0;
  GLuint device_ = 0, staging_ = 0;
  void* mapped_ = nullptr;         // of the staging buffer
  std::vector<std::byte> memory_;  // where it cannot stay mapped
};

/// From the device. The shader writes straight to it.
class ReadBackBuffer {
 public:
  explicit ReadBackBuffer(ShaderBuffer binding) : binding_(binding) {}

  bool holds(std::size_t bytes) const { return bytes <= capacity_; }
  Result<void> reserve(const Gl& gl, std::size_t bytes);
  /// To be issued between the shader and the fence that is waited for before receive().
  void order_after_shader(const Gl& gl) const;
  /// The first bytes of what the shader has written go to the memory.
  Result<void> receive(const Gl& gl, std::size_t bytes);
  const void* memory() const { return mapped_ ? mapped_ : memory_.data(); }

 private:
  ShaderBuffer binding_;
  std::size_t capacity_ = 0;
  GLuint buffer_ = 0;
  const void* mapped_ = nullptr;
  std::vector<std::byte> memory_;  // where it cannot stay mapped
};

}  // namespace barehand
