#pragma once

#include <GLES3/gl32.h>

#include <GLES2/gl2ext.h>  // needs the types of gl32.h

#include "core/error.h"
#include "observe/egl/egl_functions.h"

namespace barehand {

// The functions of OpenGL ES 3.1 that compute shaders, their buffers and fences need.
// clang-format off
#define BAREHAND_GL_FUNCTIONS(f) \
  f(PFNGLATTACHSHADERPROC, AttachShader) \
  f(PFNGLBINDBUFFERPROC, BindBuffer) \
  f(PFNGLBINDBUFFERBASEPROC, BindBufferBase) \
  f(PFNGLBUFFERDATAPROC, BufferData) \
  f(PFNGLBUFFERSUBDATAPROC, BufferSubData) \
  f(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync) \
  f(PFNGLCOMPILESHADERPROC, CompileShader) \
  f(PFNGLCOPYBUFFERSUBDATAPROC, CopyBufferSubData) \
  f(PFNGLCREATEPROGRAMPROC, CreateProgram) \
  f(PFNGLCREATESHADERPROC, CreateShader) \
  f(PFNGLDELETEBUFFERSPROC, DeleteBuffers) \
  f(PFNGLDELETESHADERPROC, DeleteShader) \
  f(PFNGLDELETESYNCPROC, DeleteSync) \
  f(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute) \
  f(PFNGLFENCESYNCPROC, FenceSync) \
  f(PFNGLGENBUFFERSPROC, GenBuffers) \
  f(PFNGLGETERRORPROC, GetError) \
  f(PFNGLGETINTEGERVPROC, GetIntegerv) \
  f(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog) \
  f(PFNGLGETPROGRAMIVPROC, GetProgramiv) \
  f(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog) \
  f(PFNGLGETSHADERIVPROC, GetShaderiv) \
  f(PFNGLGETSTRINGPROC, GetString) \
  f(PFNGLLINKPROGRAMPROC, LinkProgram) \
  f(PFNGLMAPBUFFERRANGEPROC, MapBufferRange) \
  f(PFNGLMEMORYBARRIERPROC, MemoryBarrier) \
  f(PFNGLSHADERSOURCEPROC, ShaderSource) \
  f(PFNGLUNIFORM1FPROC, Uniform1f) \
  f(PFNGLUNIFORM1IPROC, Uniform1i) \
  f(PFNGLUNIFORM2IPROC, Uniform2i) \
  f(PFNGLUNIFORM2IVPROC, Uniform2iv) \
  f(PFNGLUNIFORM4FPROC, Uniform4f) \
  f(PFNGLUNMAPBUFFERPROC, UnmapBuffer) \
  f(PFNGLUSEPROGRAMPROC, UseProgram)
// clang-format on

/// Functions of OpenGL ES, to be called only on a thread with a current context.
struct Gl {
#define BAREHAND_GL_MEMBER(type, name) type name = nullptr;
  BAREHAND_GL_FUNCTIONS(BAREHAND_GL_MEMBER)
#undef BAREHAND_GL_MEMBER
  PFNGLBUFFERSTORAGEEXTPROC BufferStorageEXT = nullptr;              ///< null: buffers cannot stay mapped
  PFNGLGETGRAPHICSRESETSTATUSPROC GetGraphicsResetStatus = nullptr;  ///< null: the driver does not report resets
};

/// Loads the functions; a context must be current. Error: a function is missing.
Result<Gl> load_gl(const Egl& egl);

/// Returns an error if a GL function failed since the last call or the context was lost. `doing` describes the work for
/// the message, for example "reading distances".
Result<void> check_gl(const Gl& gl, const char* doing);

}  // namespace barehand
