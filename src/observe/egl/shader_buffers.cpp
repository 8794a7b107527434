#include "observe/egl/shader_buffers.h"

#include <algorithm>
#include <cstring>

namespace barehand {
namespace {

// Creates and fills the shader's buffers; they stay mapped if the driver supports this.

constexpr GLbitfield kStaysMapped = GL_MAP_PERSISTENT_BIT_EXT | GL_MAP_COHERENT_BIT_EXT;

/// Returns a size with a reserve, because regions of interest and numbers of samples change a little between frames.
std::size_t with_room(std::size_t bytes) { return bytes + bytes / 2; }

/// Makes a buffer that is bound to `target` and stays mapped for `access`. Sets `mapped` to null if the driver cannot
/// map it.
GLuint make_mapped(const Gl& gl, GLenum target, std::size_t bytes, GLbitfield access, void*& mapped) {
  GLuint buffer = 0;
  const auto size = static_cast<GLsizeiptr>(bytes);
  gl.GenBuffers(1, &buffer);
  gl.BindBuffer(target, buffer);
  gl.BufferStorageEXT(target, size, nullptr, access | kStaysMapped);
  mapped = gl.MapBufferRange(target, 0, size, access | kStaysMapped);
  return buffer;
}

/// Makes a buffer at the shader's binding `binding`.
GLuint make_bound(const Gl& gl, ShaderBuffer binding, std::size_t bytes, GLenum usage) {
  GLuint buffer = 0;
  gl.GenBuffers(1, &buffer);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
  gl.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, usage);
  return buffer;
}

Result<void> check_made(const Gl& gl, bool usable) {
  const auto checked = check_gl(gl, "making buffers");
  return checked && !usable ? fail("a buffer cannot be mapped", "OpenGL ES") : checked;
}

}  // namespace

Result<void> UploadBuffer::reserve(const Gl& gl, std::size_t bytes) {
  if (holds(bytes)) return {};
  capacity_ = 0;
  bytes = with_room(bytes);

  // Delete the old buffers before making new ones, because device memory may be short. OpenGL ignores the name 0.
  for (const GLuint old : {device_, staging_}) gl.DeleteBuffers(1, &old);
  device_ = make_bound(gl, binding_, bytes, GL_DYNAMIC_DRAW);
  if (gl.BufferStorageEXT)
    staging_ = make_mapped(gl, GL_COPY_READ_BUFFER, bytes, GL_MAP_WRITE_BIT, mapped_);
  else
    memory_.resize(bytes);

  const auto made = check_made(gl, memory() != nullptr);
  if (made) capacity_ = bytes;
  return made;
}

void UploadBuffer::send(const Gl& gl, std::size_t bytes) const {
  const auto size = static_cast<GLsizeiptr>(bytes);
  gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, device_);
  if (mapped_) {
    gl.BindBuffer(GL_COPY_READ_BUFFER, staging_);
    gl.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_SHADER_STORAGE_BUFFER, 0, 0, size);
  } else {
    gl.BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, size, memory_.data());
  }
}

Result<void> ReadBackBuffer::reserve(const Gl& gl, std::size_t bytes) {
  if (holds(bytes)) return {};
  capacity_ = 0;
  bytes = with_room(bytes);

  gl.DeleteBuffers(1, &buffer_);
  if (gl.BufferStorageEXT) {
    void* mapped = nullptr;
    buffer_ = make_mapped(gl, GL_SHADER_STORAGE_BUFFER, bytes, GL_MAP_READ_BIT, mapped);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_, buffer_);
    mapped_ = mapped;
  } else {
    buffer_ = make_bound(gl, binding_, bytes, GL_STREAM_READ);
    memory_.resize(bytes);
  }

  const auto made = check_made(gl, memory() != nullptr);
  if (made) capacity_ = bytes;
  return made;
}

void ReadBackBuffer::order_after_shader(const Gl& gl) const {
  gl.MemoryBarrier(mapped_ ? GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT_EXT : GL_BUFFER_UPDATE_BARRIER_BIT);
}

Result<void> ReadBackBuffer::receive(const Gl& gl, std::size_t bytes) {
  if (mapped_) return {};
  gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_);
  const void* results = gl.MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
  if (!results) return fail("the distances cannot be read", "OpenGL ES");
  std::memcpy(memory_.data(), results, bytes);
  if (!gl.UnmapBuffer(GL_SHADER_STORAGE_BUFFER)) return fail("the distances were lost while being read", "OpenGL ES");
  return {};
}

}  // namespace barehand
