#pragma once
// What a renderer has done: a feature that costs nothing where it is not used can be seen here.
#include <cstddef>

namespace softreel::render {

/// What was done since the renderer was made. A feature that a scene does not use leaves its counter at 0.
struct RenderCounters {
  std::size_t accumulation_buffers = 0;  ///< made; 0 for samples = 1
  std::size_t shadow_maps = 0;           ///< textures made; 0 without a light that casts shadows
  std::size_t textures = 0;              ///< base-colour textures uploaded
  std::size_t mesh_uploads = 0;          ///< of positions and normals; one per mesh that does not move
  std::size_t pictures_reused = 0;       ///< nothing had changed since the picture before
  std::size_t passes = 0;                ///< accumulation passes drawn
  std::size_t shadow_passes = 0;         ///< shadow maps drawn
  std::size_t draw_calls = 0;            ///< shadow passes included
};

}  // namespace softreel::render
