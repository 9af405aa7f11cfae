#pragma once
// Colours for numbers.
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace softreel::render {

/// Anchors stand at equal distances; between two of them sRGB values are interpolated linearly.
struct ColorMap {
  std::string_view name;
  std::string_view source;
  std::span<const std::uint32_t> anchors;  ///< 0xRRGGBB, from the lowest value to the highest
};

/// The one table.
std::span<const ColorMap> color_maps();

/// Index into color_maps(). Throws std::invalid_argument for a name that it does not have.
std::size_t color_map_index(std::string_view name);

/// sRGB components 0..1 at t; beyond 0..1 the colours of the ends, for NaN grey.
glm::vec3 color_at(const ColorMap& map, float t);

inline constexpr int kColorMapTexels = 1024;  ///< of a map, on the GPU

/// The texels of all maps, one row each, linear: what the shader looks colours up in. The nearest texel is at most
/// half a level of 255 away from color_at for maps of nine anchors or more.
std::span<const glm::vec4> color_map_texels();

}  // namespace softreel::render
