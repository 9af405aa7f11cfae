#include "assets/scene_colors.h"

#include <array>

namespace softreel::assets {

namespace {

struct NamedColor {
  const char* name;
  unsigned rgb;
};

// A small palette that goes together, not the web's.
constexpr std::array kColors = {
    NamedColor{"black", 0x1a1a1a},   NamedColor{"white", 0xf5f5f5},      NamedColor{"grey", 0x808080},
    NamedColor{"gray", 0x808080},    NamedColor{"light-grey", 0xc8c8c8}, NamedColor{"dark-grey", 0x404040},
    NamedColor{"red", 0xc8372d},     NamedColor{"crimson", 0x9e1b32},    NamedColor{"coral", 0xee7b5d},
    NamedColor{"orange", 0xe8883a},  NamedColor{"amber", 0xf2b134},      NamedColor{"yellow", 0xf0cf4a},
    NamedColor{"lime", 0xa5c84b},    NamedColor{"green", 0x4c9f50},      NamedColor{"olive", 0x7c8041},
    NamedColor{"mint", 0x9bd3b8},    NamedColor{"teal", 0x2a8c82},       NamedColor{"turquoise", 0x45b8ac},
    NamedColor{"sky", 0x8ec5e8},     NamedColor{"blue", 0x3b6fb6},       NamedColor{"navy", 0x25375e},
    NamedColor{"indigo", 0x4b4a9e},  NamedColor{"purple", 0x7d4c9e},     NamedColor{"lilac", 0xb9a3d6},
    NamedColor{"magenta", 0xc04a8f}, NamedColor{"pink", 0xefa7b8},       NamedColor{"brown", 0x7a5236},
    NamedColor{"tan", 0xd9a066},     NamedColor{"sand", 0xdcc9a3},       NamedColor{"cream", 0xf3ead3},
    NamedColor{"gold", 0xd4af37},    NamedColor{"copper", 0xc17a4f},     NamedColor{"silver", 0xc9ccd1},
};

Color from_rgb(unsigned rgb) { return {(rgb >> 16 & 255) / 255., (rgb >> 8 & 255) / 255., (rgb & 255) / 255.}; }

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return {};
}

}  // namespace

std::optional<Color> parse_color(std::string_view text) {
  if (text.starts_with('#') && (text.size() == 4 || text.size() == 7)) {
    unsigned rgb = 0;
    for (char c : text.substr(1)) {
      const auto digit = hex_digit(c);
      if (!digit) return {};
      rgb = rgb << 4 | *digit;
      if (text.size() == 4) rgb = rgb << 4 | *digit;  // #abc is #aabbcc
    }
    return from_rgb(rgb);
  }
  for (const NamedColor& color : kColors)
    if (text == color.name) return from_rgb(color.rgb);
  return {};
}

std::vector<std::string> color_names() {
  std::vector<std::string> names;
  for (const NamedColor& color : kColors) names.emplace_back(color.name);
  return names;
}

}  // namespace softreel::assets
