#include "render/programs.h"

#include <algorithm>
#include <bit>

#include "render/color_map.h"

namespace softreel::render {

namespace {

constexpr GLenum kMaxAnisotropy = 0x84FE;  // GL_TEXTURE_MAX_ANISOTROPY, core since 4.6, an extension everywhere before

}  // namespace

GLuint Programs::geometry(const GeometryFeatures& features) {
  const auto place = geometry_.find(features);
  if (place != geometry_.end()) return *place->second;
  GlProgram program(gl_, geometry_vertex_source(features), geometry_fragment_source(features));
  return *geometry_.emplace(features, std::move(program)).first->second;
}

GLuint Programs::lighting(const LightingFeatures& features) {
  const auto place = lighting_.find(features);
  if (place != lighting_.end()) return *place->second;
  GlProgram program(gl_, lighting_vertex_source(features), lighting_fragment_source(features));
  return *lighting_.emplace(features, std::move(program)).first->second;
}

void ColorMapTexture::bind() {
  if (!texture_) {
    const auto rows = static_cast<int>(color_maps().size());
    texture_ = make_texture(gl_, GL_RGBA32F, kColorMapTexels, rows);
    gl_.TextureSubImage2D(*texture_, 0, 0, 0, kColorMapTexels, rows, GL_RGBA, GL_FLOAT, color_map_texels().data());
    sampler_ = make_sampler(gl_, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
    check_gl(gl_, "upload colour maps");
  }
  gl_.BindTextureUnit(kColorMapUnit, *texture_);
  gl_.BindSampler(kColorMapUnit, *sampler_);
}

void Textures::add(const Image& image, TextureKind kind, RenderCounters& counters) {
  if (textures_.contains({&image, kind})) return;
  if (!sampler_) {
    sampler_ = make_sampler(gl_, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    // Four is enough to keep slanted cloth sharp; each doubling costs as much again in software.
    gl_.SamplerParameterf(*sampler_, kMaxAnisotropy, 4);
    gl_.GetError();  // a driver without the extension refuses; trilinear then is what there is
  }
  const int levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
  GlTexture texture =
      make_texture(gl_, kind == TextureKind::kColor ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width, image.height, levels);
  gl_.TextureSubImage2D(*texture, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  gl_.GenerateTextureMipmap(*texture);
  check_gl(gl_, "upload a texture");
  textures_.emplace(std::pair(&image, kind), std::move(texture));
  ++counters.textures;
}

void Textures::bind(const Image& image, TextureKind kind, GLuint unit) const {
  gl_.BindTextureUnit(unit, *textures_.at({&image, kind}));
  gl_.BindSampler(unit, *sampler_);
}

void PanoramaTexture::bind(const Panorama& panorama, RenderCounters& counters) {
  if (uploaded_ != &panorama) {
    uploaded_ = &panorama;
    const Panorama::Level& first = panorama.levels().front();
    texture_ = make_texture(gl_, GL_RGBA32F, first.width, first.height, Panorama::kLevels);
    for (int level = 0; level < Panorama::kLevels; ++level) {
      const Panorama::Level& l = panorama.levels()[static_cast<std::size_t>(level)];
      gl_.TextureSubImage2D(*texture_, level, 0, 0, l.width, l.height, GL_RGBA, GL_FLOAT, l.texels.data());
    }
    sampler_ = make_sampler(gl_, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    gl_.SamplerParameteri(*sampler_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    check_gl(gl_, "upload a panorama");
    ++counters.textures;
  }
  gl_.BindTextureUnit(kPanoramaUnit, *texture_);
  gl_.BindSampler(kPanoramaUnit, *sampler_);
}

}  // namespace softreel::render
