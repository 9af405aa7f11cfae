#include "render/gl_functions.h"

#include <fmt/format.h>

#include "render/error.h"
#include "render/gl_context.h"

namespace softreel::render {

GlFunctions load_gl_functions() {
  GlFunctions gl;
#define SOFTREEL_GL_LOAD(type, name)                                 \
  gl.name = reinterpret_cast<type>(GlContext::function("gl" #name)); \
  if (gl.name == nullptr) throw RenderError(RenderErrorKind::kContext, "the OpenGL driver has no gl" #name);
  SOFTREEL_GL_FUNCTIONS(SOFTREEL_GL_LOAD)
#undef SOFTREEL_GL_LOAD
  return gl;
}

void check_gl(const GlFunctions& gl, const char* what) {
  const GLenum error = gl.GetError();
  if (error != GL_NO_ERROR)
    throw RenderError(RenderErrorKind::kContext, error == GL_OUT_OF_MEMORY
                                                     ? fmt::format("not enough memory to {}", what)
                                                     : fmt::format("OpenGL error 0x{:04x}: cannot {}", error, what));
}

}  // namespace softreel::render
