#include "render/gl_objects.h"

#include <algorithm>

#include "render/error.h"

namespace softreel::render {

namespace {

GLuint compile(const GlFunctions& gl, GLenum kind, const std::string& source) {
  const GLuint shader = gl.CreateShader(kind);
  const GLchar* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint ok = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  gl.DeleteShader(shader);
  throw RenderError(RenderErrorKind::kContext, "a shader does not compile: " + log);
}

}  // namespace

GlBuffer make_buffer(const GlFunctions& gl, std::size_t bytes, const void* data, GLbitfield flags) {
  GLuint name = 0;
  gl.CreateBuffers(1, &name);
  GlBuffer buffer(gl, name);
  gl.NamedBufferStorage(name, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 1)), bytes > 0 ? data : nullptr,
                        flags);
  check_gl(gl, "make a buffer");
  return buffer;
}

GlTexture make_texture(const GlFunctions& gl, GLenum format, int width, int height, int levels) {
  GLuint name = 0;
  gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
  GlTexture texture(gl, name);
  gl.TextureStorage2D(name, levels, format, width, height);
  check_gl(gl, "make a texture");
  return texture;
}

GlFramebuffer make_framebuffer(const GlFunctions& gl) {
  GLuint name = 0;
  gl.CreateFramebuffers(1, &name);
  return {gl, name};
}

GlVertexArray make_vertex_array(const GlFunctions& gl) {
  GLuint name = 0;
  gl.CreateVertexArrays(1, &name);
  return {gl, name};
}

GlSampler make_sampler(const GlFunctions& gl, GLint min_filter, GLint mag_filter, GLint wrap) {
  GLuint name = 0;
  gl.CreateSamplers(1, &name);
  gl.SamplerParameteri(name, GL_TEXTURE_MIN_FILTER, min_filter);
  gl.SamplerParameteri(name, GL_TEXTURE_MAG_FILTER, mag_filter);
  gl.SamplerParameteri(name, GL_TEXTURE_WRAP_S, wrap);
  gl.SamplerParameteri(name, GL_TEXTURE_WRAP_T, wrap);
  return {gl, name};
}

void check_framebuffer(const GlFunctions& gl, const GlFramebuffer& framebuffer, const char* what) {
  if (gl.CheckNamedFramebufferStatus(*framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RenderError(RenderErrorKind::kContext, std::string("OpenGL cannot draw into ") + what);
}

GlProgram::GlProgram(const GlFunctions& gl, const std::string& vertex_source, const std::string& fragment_source)
    : gl_(&gl) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, vertex_source);
  GLuint fragment = 0;
  try {
    fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_source);
  } catch (...) {
    gl.DeleteShader(vertex);
    throw;
  }
  name_ = gl.CreateProgram();
  gl.AttachShader(name_, vertex);
  gl.AttachShader(name_, fragment);
  gl.LinkProgram(name_);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint ok = GL_FALSE;
  gl.GetProgramiv(name_, GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  gl.DeleteProgram(std::exchange(name_, 0));
  throw RenderError(RenderErrorKind::kContext, "a shader does not link: " + log);
}

}  // namespace softreel::render
