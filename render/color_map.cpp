#include "render/color_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/look.h"

namespace softreel::render {

namespace {

constexpr std::uint32_t kViridis[] = {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                      0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};
constexpr std::uint32_t kInferno[] = {0x000004, 0x210c4a, 0x57106e, 0x8a226a, 0xbc3754,
                                      0xe45a31, 0xf98e09, 0xf9cb35, 0xfcffa4};
constexpr std::uint32_t kMagma[] = {0x000004, 0x1d1147, 0x51127c, 0x832681, 0xb73779,
                                    0xe75263, 0xfc8961, 0xfec488, 0xfcfdbf};
constexpr std::uint32_t kCividis[] = {0x002051, 0x012b65, 0x11366c, 0x26426e, 0x3c4d6e, 0x51586e,
                                      0x62646f, 0x727071, 0x7f7c75, 0x8c8877, 0x9a9478, 0xa9a177,
                                      0xbbaf71, 0xcebd68, 0xe2cb5c, 0xf3da4f, 0xfdea45};
constexpr std::uint32_t kCoolwarm[] = {0x3b4cc0, 0x4d68d7, 0x6282ea, 0x779af7, 0x8db0fe, 0xa3c2ff,
                                       0xb8d0f9, 0xccd9ee, 0xdddddd, 0xecd3c5, 0xf5c4ad, 0xf7b194,
                                       0xf49a7b, 0xec7f63, 0xde604d, 0xcb3e38, 0xb40426};

constexpr const char* kListed = "van der Walt, Smith 2015: \"A Better Default Colormap for Matplotlib\" (CC0)";

constexpr ColorMap kMaps[] = {
    {"viridis", kListed, kViridis},
    {"inferno", kListed, kInferno},
    {"magma", kListed, kMagma},
    {"cividis",
     "Nunez, Anderton, Renslow 2018: \"Optimizing colormaps with consideration for color vision deficiency\"; "
     "as the polynomial of d3-scale-chromatic",
     kCividis},
    {"coolwarm", "Moreland 2009: \"Diverging Color Maps for Scientific Visualization\"", kCoolwarm},
};

glm::vec3 components(std::uint32_t hex) {
  return glm::vec3((hex >> 16) & 255u, (hex >> 8) & 255u, hex & 255u) / 255.0f;
}

}  // namespace

std::span<const ColorMap> color_maps() { return kMaps; }

std::size_t color_map_index(std::string_view name) {
  for (std::size_t i = 0; i < std::size(kMaps); ++i)
    if (kMaps[i].name == name) return i;
  throw std::invalid_argument("there is no colour map '" + std::string(name) + "'");
}

glm::vec3 color_at(const ColorMap& map, float t) {
  if (std::isnan(t)) return glm::vec3(0.5f);
  const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(map.anchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), map.anchors.size() - 2);
  return glm::mix(components(map.anchors[below]), components(map.anchors[below + 1]), at - static_cast<float>(below));
}

std::span<const glm::vec4> color_map_texels() {
  static const std::vector<glm::vec4> texels = [] {
    std::vector<glm::vec4> all;
    for (const ColorMap& map : kMaps)
      for (int i = 0; i < kColorMapTexels; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(kColorMapTexels - 1);
        all.emplace_back(linear_from_srgb(color_at(map, t)), 1);
      }
    return all;
  }();
  return texels;
}

}  // namespace softreel::render
