#include "render/picture_targets.h"

#include <array>

#include "render/shader_sources.h"

namespace softreel::render {

PictureTargets::PictureTargets(const GlFunctions& gl, int width, int height) : gl_(gl), width_(width), height_(height) {
  surface_ = make_texture(gl, GL_RGBA32UI, width, height);
  depth_ = make_texture(gl, GL_DEPTH_COMPONENT32F, width, height);
  geometry_ = make_framebuffer(gl);
  gl.NamedFramebufferTexture(*geometry_, GL_COLOR_ATTACHMENT0, *surface_, 0);
  gl.NamedFramebufferTexture(*geometry_, GL_DEPTH_ATTACHMENT, *depth_, 0);
  check_framebuffer(gl, geometry_, "a picture of surfaces");
  color_ = make_texture(gl, GL_RGBA32F, width, height);
  film_ = make_framebuffer(gl);
  gl.NamedFramebufferTexture(*film_, GL_COLOR_ATTACHMENT0, *color_, 0);
  check_framebuffer(gl, film_, "a picture of floats");
  nearest_ = make_sampler(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
}

void PictureTargets::add_display() {
  if (display_) return;
  display_ = make_texture(gl_, GL_RGBA32F, width_, height_);
  gl_.NamedFramebufferTexture(*film_, GL_COLOR_ATTACHMENT1, *display_, 0);
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.NamedFramebufferDrawBuffers(*film_, kBoth.size(), kBoth.data());
  check_framebuffer(gl_, film_, "a picture of floats in two layers");
}

void PictureTargets::add_emission() {
  if (emission_) return;
  emission_ = make_texture(gl_, GL_RGBA32F, width_, height_);
  gl_.NamedFramebufferTexture(*geometry_, GL_COLOR_ATTACHMENT1, *emission_, 0);
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.NamedFramebufferDrawBuffers(*geometry_, kBoth.size(), kBoth.data());
  check_framebuffer(gl_, geometry_, "a picture of surfaces that give off light");
}

void PictureTargets::begin_geometry() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, *geometry_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_BLEND);
  gl_.CullFace(GL_BACK);
  constexpr std::array<GLuint, 4> kNothing{};
  constexpr float kFarthest = 1;
  gl_.ClearNamedFramebufferuiv(*geometry_, GL_COLOR, 0, kNothing.data());
  gl_.ClearNamedFramebufferfv(*geometry_, GL_DEPTH, 0, &kFarthest);
}

void PictureTargets::begin_lighting(int pass, int passes, RenderCounters& counters) {
  if (passes > 1 && !summed_) {
    summed_ = true;
    ++counters.accumulation_buffers;
  }
  gl_.BindFramebuffer(GL_FRAMEBUFFER, *film_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  // The first pass overwrites: no clearing needed.
  if (pass == 0) {
    gl_.Disable(GL_BLEND);
  } else {
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE, GL_ONE);
  }
  gl_.BindTextureUnit(kSurfaceUnit, *surface_);
  gl_.BindSampler(kSurfaceUnit, *nearest_);
  if (emission_) {
    gl_.BindTextureUnit(kEmissionUnit, *emission_);
    gl_.BindSampler(kEmissionUnit, *nearest_);
  }
  gl_.BindTextureUnit(kDepthUnit, *depth_);
  gl_.BindSampler(kDepthUnit, *nearest_);
}

void PictureTargets::read_geometry(std::vector<glm::uvec4>& words, std::vector<float>& depth) {
  const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  words.resize(count);
  depth.resize(count);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, *geometry_);
  gl_.NamedFramebufferReadBuffer(*geometry_, GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA_INTEGER, GL_UNSIGNED_INT, words.data());
  gl_.ReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  check_gl(gl_, "read depth and normals");
}

FloatImage PictureTargets::read(float weight) {
  FloatImage film;
  film.width = width_;
  film.height = height_;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, *film_);
  const auto read_layer = [&](GLenum attachment, std::vector<glm::vec4>& layer) {
    layer.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    gl_.NamedFramebufferReadBuffer(*film_, attachment);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, layer.data());
    if (weight != 1)
      for (glm::vec4& pixel : layer) pixel *= weight;
  };
  read_layer(GL_COLOR_ATTACHMENT0, film.rgba);
  if (display_) read_layer(GL_COLOR_ATTACHMENT1, film.display);
  check_gl(gl_, "draw a picture");
  return film;
}

}  // namespace softreel::render
