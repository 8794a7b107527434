// Loads the functions of OpenGL ES.
#include "observe/egl/gl_functions.h"

#include "core/format.h"

namespace barehand {

Result<Gl> load_gl(const Egl& egl) {
  // Load the functions that are required.
  Gl gl;
#define BAREHAND_GL_LOAD(type, name)                                \
  gl.name = reinterpret_cast<type>(egl.GetProcAddress("gl" #name)); \
  if (!gl.name) return fail("gl" #name " is missing", "OpenGL ES", "update the graphics driver");
  BAREHAND_GL_FUNCTIONS(BAREHAND_GL_LOAD)
#undef BAREHAND_GL_LOAD

  // EGL may return an address for any name, so ask only for functions of extensions that the driver lists.
  const auto* extensions = reinterpret_cast<const char*>(gl.GetString(GL_EXTENSIONS));
  for (const char* suffix : {"EXT", "KHR"}) {
    const bool khr = suffix[0] == 'K';
    if (!has_extension(extensions, khr ? "GL_KHR_robustness" : "GL_EXT_robustness")) continue;
    const std::string name = std::string("glGetGraphicsResetStatus") + suffix;
    gl.GetGraphicsResetStatus = reinterpret_cast<PFNGLGETGRAPHICSRESETSTATUSPROC>(egl.GetProcAddress(name.c_str()));
  }

  // Persistently mapped buffers are used where the driver has them.
  if (has_extension(extensions, "GL_EXT_buffer_storage"))
    gl.BufferStorageEXT = reinterpret_cast<PFNGLBUFFERSTORAGEEXTPROC>(egl.GetProcAddress("glBufferStorageEXT"));
  return gl;
}

Result<void> check_gl(const Gl& gl, const char* doing) {
  const GLenum error = gl.GetError();
  const GLenum reset = gl.GetGraphicsResetStatus ? gl.GetGraphicsResetStatus() : GLenum{GL_NO_ERROR};
  if (error == GL_NO_ERROR && reset == GL_NO_ERROR) return {};
  if (error == GL_CONTEXT_LOST || reset != GL_NO_ERROR)
    return fail(std::string("the context was lost while ") + doing, "OpenGL ES");
  return fail(formatted("error 0x%04x while %s", error, doing), "OpenGL ES");
}

}  // namespace barehand
