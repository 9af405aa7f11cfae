#pragma once
// GL names that delete themselves. All need their context to be current.
#include <string>
#include <utility>

#include "render/gl_functions.h"

namespace softreel::render {

/// Owns one GL name; `Delete` is a member of GlFunctions that takes (count, names).
template <auto Delete>
class GlName {
 public:
  GlName() = default;
  GlName(const GlFunctions& gl, GLuint name) : gl_(&gl), name_(name) {}
  GlName(GlName&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  ~GlName() {
    if (name_ != 0) (gl_->*Delete)(1, &name_);
  }
  GLuint operator*() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};

using GlBuffer = GlName<&GlFunctions::DeleteBuffers>;
using GlTexture = GlName<&GlFunctions::DeleteTextures>;
using GlFramebuffer = GlName<&GlFunctions::DeleteFramebuffers>;
using GlVertexArray = GlName<&GlFunctions::DeleteVertexArrays>;
using GlSampler = GlName<&GlFunctions::DeleteSamplers>;

GlBuffer make_buffer(const GlFunctions& gl, std::size_t bytes, const void* data, GLbitfield flags);
GlTexture make_texture(const GlFunctions& gl, GLenum format, int width, int height, int levels = 1);
GlFramebuffer make_framebuffer(const GlFunctions& gl);
GlVertexArray make_vertex_array(const GlFunctions& gl);
GlSampler make_sampler(const GlFunctions& gl, GLint min_filter, GLint mag_filter, GLint wrap);
/// Throws RenderError (kContext) when the framebuffer is not complete.
void check_framebuffer(const GlFunctions& gl, const GlFramebuffer& framebuffer, const char* what);

/// A linked program.
class GlProgram {
 public:
  GlProgram() = default;
  /// Throws RenderError (kContext) with the compiler's log.
  GlProgram(const GlFunctions& gl, const std::string& vertex_source, const std::string& fragment_source);
  GlProgram(GlProgram&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  GlProgram& operator=(GlProgram&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlProgram() {
    if (name_ != 0) gl_->DeleteProgram(name_);
  }
  GLuint operator*() const { return name_; }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};

}  // namespace softreel::render
