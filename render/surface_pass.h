#pragma once
// Draws parts of meshes into the geometry target, each with the program that its look needs.
#include <cstdint>

#include "render/counters.h"
#include "render/gpu_mesh.h"
#include "render/programs.h"

namespace softreel::render {

/// What a look asks the geometry program for. `emission`: some look of the picture gives off light, so all programs
/// write that layer.
GeometryFeatures geometry_features(const Look& look, const GpuMesh& mesh, bool emission);

class SurfacePass {
 public:
  SurfacePass(const GlFunctions& gl, Programs& programs, Textures& textures, RenderCounters& counters, bool emission)
      : gl_(gl), programs_(programs), textures_(textures), counters_(counters), emission_(emission) {}

  /// From now on the words hold this number in place of the facet; looks do not matter then.
  void note_id(std::uint16_t id) { id_ = id; }
  /// All parts of a body with their looks, and the edges over them where those are asked for.
  void draw_body(const GpuMesh& mesh);
  /// The ground: roughness 0 in the noted words tells the lighting program.
  void draw_ground(const GpuMesh& mesh, const Look& look);

 private:
  void draw_part(const GpuMesh& mesh, const MeshPart& part, const Look& look, float roughness, bool wire);
  void bind_textures(const Look& look, const GeometryFeatures& features);

  const GlFunctions& gl_;
  Programs& programs_;
  Textures& textures_;
  RenderCounters& counters_;
  bool emission_;
  std::uint16_t id_ = 0;
};

}  // namespace softreel::render
