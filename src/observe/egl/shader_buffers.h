#pragma once

#include <cstddef>
#include <vector>

#include "core/error.h"
#include "observe/egl/compare_shader.h"
#include "observe/egl/gl_functions.h"

namespace barehand {

// Buffers of the shader, and the memory through which a thread without the context writes and reads them. If the driver
// supports GL_EXT_buffer_storage, this memory is the driver's own and stays mapped. Buffers only grow, so that frames
// of similar size allocate nothing. Functions that need the context take a `Gl`; the buffers are destroyed with the
// context.

/// A buffer for data that is sent to the device. The shader reads a copy in the device's own memory, because it reads
/// the data many times.
class UploadBuffer {
 public:
  explicit UploadBuffer(ShaderBuffer binding) : binding_(binding) {}

  bool holds(std::size_t bytes) const { return bytes <= capacity_; }
  /// Makes room for `bytes`. If the buffer has to grow, its content is lost.
  Result<void> reserve(const Gl& gl, std::size_t bytes);
  /// The reserved memory, to be written only while the device is idle.
  void* memory() { return mapped_ ? mapped_ : memory_.data(); }
  /// Copies the first `bytes` of the memory to the device.
  void send(const Gl& gl, std::size_t bytes) const;

 private:
  ShaderBuffer binding_;
  std::size_t capacity_ = 0;
  GLuint device_ = 0, staging_ = 0;
  void* mapped_ = nullptr;         // memory of the staging buffer; null if it cannot stay mapped
  std::vector<std::byte> memory_;  // used if the staging buffer cannot stay mapped
};

/// A buffer for data that is received from the device. The shader writes directly to it.
class ReadBackBuffer {
 public:
  explicit ReadBackBuffer(ShaderBuffer binding) : binding_(binding) {}

  bool holds(std::size_t bytes) const { return bytes <= capacity_; }
  Result<void> reserve(const Gl& gl, std::size_t bytes);
  /// Orders the memory accesses. Must be called after the dispatch of the shader and before the fence that is waited
  /// for.
  void order_after_shader(const Gl& gl) const;
  /// Makes the first `bytes` of the shader's results available in memory().
  Result<void> receive(const Gl& gl, std::size_t bytes);
  const void* memory() const { return mapped_ ? mapped_ : memory_.data(); }

 private:
  ShaderBuffer binding_;
  std::size_t capacity_ = 0;
  GLuint buffer_ = 0;
  const void* mapped_ = nullptr;
  std::vector<std::byte> memory_;  // used if the buffer cannot stay mapped
};

}  // namespace barehand
