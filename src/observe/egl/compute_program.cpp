// Compiles a compute shader to a program.
#include "observe/egl/compute_program.h"

namespace barehand {
namespace {

constexpr GLsizei kLogSize = 2000;

/// Checks whether a shader was compiled or a program linked. `get_status` and `get_log` are the GL functions for that
/// kind of object.
template <class GetStatus, class GetLog>
Result<void> check(GLuint object, GLenum what, GetStatus get_status, GetLog get_log) {
  GLint done = GL_FALSE;
  get_status(object, what, &done);
  if (done) return {};
  std::string log(kLogSize, '\0');
  GLsizei length = 0;
  get_log(object, kLogSize, &length, log.data());
  log.resize(length);
  return fail("the driver rejects the compute shader: " + log, "OpenGL ES", "update the graphics driver");
}

}  // namespace

Result<GLuint> make_compute_program(const Gl& gl, const std::string& source) {
  // Compile the shader.
  const GLuint shader = gl.CreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  const auto compiled = check(shader, GL_COMPILE_STATUS, gl.GetShaderiv, gl.GetShaderInfoLog);
  if (!compiled) return tl::unexpected(compiled.error());

  // Link it into a program, which then no longer needs the shader object.
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, shader);
  gl.LinkProgram(program);
  gl.DeleteShader(shader);
  const auto linked = check(program, GL_LINK_STATUS, gl.GetProgramiv, gl.GetProgramInfoLog);
  if (!linked) return tl::unexpected(linked.error());
  return program;
}

}  // namespace barehand
