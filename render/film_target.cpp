#include "render/film_target.h"

#include <glm/gtc/type_ptr.hpp>

#include "render/shader_sources.h"

namespace softreel::render {

FilmTarget::FilmTarget(const GlFunctions& gl, int width, int height) : gl_(gl), width_(width), height_(height) {
  color_ = make_texture(gl, GL_RGBA32F, width, height);
  depth_ = make_texture(gl, GL_DEPTH_COMPONENT32F, width, height);
  framebuffer_ = make_framebuffer(gl);
  gl.NamedFramebufferTexture(*framebuffer_, GL_COLOR_ATTACHMENT0, *color_, 0);
  gl.NamedFramebufferTexture(*framebuffer_, GL_DEPTH_ATTACHMENT, *depth_, 0);
  check_framebuffer(gl, framebuffer_, "a picture of floats");
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

void FilmTarget::begin_pass() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, *framebuffer_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.DepthMask(GL_TRUE);
  const glm::vec4 nothing(0);
  constexpr float kFarthest = 1;
  gl_.ClearNamedFramebufferfv(*framebuffer_, GL_COLOR, 0, glm::value_ptr(nothing));
  gl_.ClearNamedFramebufferfv(*framebuffer_, GL_DEPTH, 0, &kFarthest);
}

void FilmTarget::make_accumulation() {
  accumulation_ = std::make_unique<Accumulation>();
  Accumulation& a = *accumulation_;
  a.sum = make_texture(gl_, GL_RGBA32F, width_, height_);
  a.framebuffer = make_framebuffer(gl_);
  gl_.NamedFramebufferTexture(*a.framebuffer, GL_COLOR_ATTACHMENT0, *a.sum, 0);
  check_framebuffer(gl_, a.framebuffer, "an accumulation buffer");
  a.copy = GlProgram(gl_, copy_vertex_source(), copy_fragment_source());
  a.no_vertices = make_vertex_array(gl_);
}

void FilmTarget::accumulate(bool first, RenderCounters& counters) {
  if (!accumulation_) {
    make_accumulation();
    ++counters.accumulation_buffers;
  }
  const Accumulation& a = *accumulation_;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, *a.framebuffer);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  // The first pass overwrites: no clearing needed. Passes are added in order, so the sum has the same bits every time.
  if (first) {
    gl_.Disable(GL_BLEND);
  } else {
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE);
  }
  gl_.UseProgram(*a.copy);
  gl_.BindTextureUnit(kColorTextureUnit, *color_);
  gl_.BindSampler(kColorTextureUnit, 0);
  gl_.BindVertexArray(*a.no_vertices);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

FloatImage FilmTarget::read(int passes) {
  FloatImage film;
  film.width = width_;
  film.height = height_;
  film.rgba.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_.BindFramebuffer(GL_FRAMEBUFFER, passes == 1 ? *framebuffer_ : *accumulation_->framebuffer);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, film.rgba.data());
  check_gl(gl_, "draw a picture");
  if (passes > 1) {
    const float weight = 1.0f / static_cast<float>(passes);
    for (glm::vec4& pixel : film.rgba) pixel *= weight;
  }
  return film;
}

}  // namespace softreel::render
