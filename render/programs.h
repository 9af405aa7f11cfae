#pragma once
// Programs and textures by what a look needs; made when first needed.
#include <map>

#include "render/counters.h"
#include "render/gl_objects.h"
#include "render/image.h"
#include "render/shader_sources.h"

namespace softreel::render {

class Programs {
 public:
  explicit Programs(const GlFunctions& gl) : gl_(gl) {}
  GLuint geometry(GeometryKind kind);
  GLuint lighting(const LightingFeatures& features);

 private:
  const GlFunctions& gl_;
  std::map<GeometryKind, GlProgram> geometry_;
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

class ColorTextures {
 public:
  explicit ColorTextures(const GlFunctions& gl) : gl_(gl) {}
  /// Uploads the picture, unless it already is there. The picture must stay alive as long as this does.
  void add(const Image& image, RenderCounters& counters);
  void bind(const Image& image) const;

 private:
  const GlFunctions& gl_;
  std::map<const Image*, GlTexture> textures_;
  GlSampler sampler_;
};

}  // namespace softreel::render
