#pragma once
// Programs and textures by what a look needs; made when first needed.
#include <map>
#include <utility>

#include "render/counters.h"
#include "render/gl_objects.h"
#include "render/image.h"
#include "render/panorama.h"
#include "render/shader_sources.h"

namespace softreel::render {

class Programs {
 public:
  explicit Programs(const GlFunctions& gl) : gl_(gl) {}
  GLuint geometry(const GeometryFeatures& features);
  GLuint lighting(const LightingFeatures& features);

 private:
  const GlFunctions& gl_;
  std::map<GeometryFeatures, GlProgram> geometry_;
  std::map<LightingFeatures, GlProgram> lighting_;
};

/// The texture of all colour maps; made when first bound.
class ColorMapTexture {
 public:
  explicit ColorMapTexture(const GlFunctions& gl) : gl_(gl) {}
  void bind();

 private:
  const GlFunctions& gl_;
  GlTexture texture_;
  GlSampler sampler_;
};

/// The levels of a panorama; uploaded when first bound.
class PanoramaTexture {
 public:
  explicit PanoramaTexture(const GlFunctions& gl) : gl_(gl) {}
  /// The panorama must stay alive as long as this does.
  void bind(const Panorama& panorama, RenderCounters& counters);

 private:
  const GlFunctions& gl_;
  const Panorama* uploaded_ = nullptr;
  GlTexture texture_;
  GlSampler sampler_;
};

enum class TextureKind {
  kColor,   ///< sRGB
  kNumbers  ///< as they stand in the file
};

class Textures {
 public:
  explicit Textures(const GlFunctions& gl) : gl_(gl) {}
  /// Uploads the picture, unless it already is there. The picture must stay alive as long as this does.
  void add(const Image& image, TextureKind kind, RenderCounters& counters);
  void bind(const Image& image, TextureKind kind, GLuint unit) const;

 private:
  const GlFunctions& gl_;
  std::map<std::pair<const Image*, TextureKind>, GlTexture> textures_;
  GlSampler sampler_;
};

}  // namespace softreel::render
