#pragma once
// How a surface looks: metallic-roughness, as glTF 2.0 defines it.
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "render/image.h"

namespace softreel::render {

/// Colours are linear (Rec. 709 primaries); `linear_from_srgb` turns "#d9a066" into one.
enum class Pattern {
  kNone,
  kChecker,  ///< cubes in rest coordinates
  kStripes,  ///< along x of the rest coordinates
};

struct Look {
  glm::vec3 color{0.7f, 0.7f, 0.7f};     ///< base colour, linear, 0..1; multiplied with the texture
  std::shared_ptr<const Image> texture;  ///< base colour, sRGB; null: none. Shared: uploaded once per Image
  float metallic = 0;                    ///< 0 cloth, skin, plastic .. 1 metal
  float roughness = 0.5f;                ///< perceptual, 0 mirror .. 1 chalk; the GGX alpha is its square
  bool two_sided = false;                ///< also drawn from behind, with the normal turned (cloth)
  std::optional<glm::vec3> back_color;   ///< base colour seen from behind, linear; used when two_sided
  /// A field: colours by the mesh's values (Renderer::set_values) through this map (render/color_map.h). The picture
  /// then holds the map's very colours, whatever light, exposure and tone curve do, darkened by `shading`.
  std::optional<std::size_t> color_map;
  float shading = 0;                               ///< of a field: 0 not at all .. 1 by all the light that is missing
  float sheen = 0;                                 ///< 0..1: soft bright rim of fibres (velvet, wool)
  std::shared_ptr<const Image> normal_texture;     ///< tangent space, y up along v (glTF, OpenGL); null: none
  float normal_scale = 1;                          ///< of its x and y
  std::shared_ptr<const Image> roughness_texture;  ///< green times roughness, blue times metallic (glTF); null: none
  glm::vec3 emission{0};                           ///< radiance that the surface gives off itself, linear
  std::shared_ptr<const Image> emission_texture;   ///< sRGB, times `emission`; null: none
  /// Drawn where the body was at rest (SurfaceMesh::rest), so that it sticks; in place of `texture`.
  Pattern pattern = Pattern::kNone;
  glm::vec3 pattern_color{0.9f};  ///< of every other field, linear
  float pattern_size = 0.1f;      ///< of a field [m]
  std::optional<glm::vec3> wire;  ///< colour of the triangles' edges, drawn over the surface, linear
  bool emits() const { return emission != glm::vec3(0); }
  bool operator==(const Look&) const = default;
};

/// From sRGB components 0..1 (IEC 61966-2-1) to linear ones.
glm::vec3 linear_from_srgb(const glm::vec3& srgb);
/// From 0xRRGGBB.
glm::vec3 linear_from_hex(unsigned hex);

}  // namespace softreel::render
