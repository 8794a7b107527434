#pragma once

#include <string>

#include "core/error.h"
#include "observe/egl/gl_functions.h"

namespace barehand {

/// Compiles and links one compute shader. Returns the program's name in the current context. Error: contains the
/// driver's log.
Result<GLuint> make_compute_program(const Gl& gl, const std::string& source);

}  // namespace barehand
