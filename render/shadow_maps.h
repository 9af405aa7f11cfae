#pragma once
// Depth pictures seen from the lights: one layer per light that casts shadows, drawn anew for each pass.
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/counters.h"
#include "render/gl_objects.h"
#include "render/gpu_mesh.h"

namespace softreel::render {

class ShadowMaps {
 public:
  ShadowMaps(const GlFunctions& gl, int size, int layers);

  /// Draws the casters into one layer.
  void draw(int layer, const glm::mat4& clip_from_world, std::span<const GpuMesh* const> casters,
            RenderCounters& counters);
  /// For the surface programs.
  void bind() const;

  int size() const { return size_; }
  int layers() const { return static_cast<int>(framebuffers_.size()); }

 private:
  const GlFunctions& gl_;
  int size_;
  GlTexture texture_;
  std::vector<GlFramebuffer> framebuffers_;
  GlSampler compare_;
  GlSampler plain_;
  GlProgram program_;
};

}  // namespace softreel::render
