#include "render/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

// The font file, byte by byte, as the assembler reads it.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    "softreel_font_begin:\n"
    ".incbin \"" SOFTREEL_FONT
    "\"\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" const unsigned char softreel_font_begin[];

namespace softreel::render {

namespace {

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo info = [] {
    stbtt_fontinfo f{};
    if (stbtt_InitFont(&f, softreel_font_begin, 0) == 0) throw std::logic_error("the built-in font is none");
    return f;
  }();
  return info;
}

/// The next character of UTF-8 text, which it shortens; U+FFFD for what is none.
int next_character(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  bool whole = length > 0 && length <= text.size();
  for (std::size_t i = 1; whole && i < length; ++i) whole = byte(i) >> 6 == 2;
  if (!whole) {
    text.remove_prefix(1);
    return 0xfffd;
  }
  constexpr std::array<unsigned, 5> kMask = {0, 0x7f, 0x1f, 0x0f, 0x07};
  unsigned code = first & kMask[length];
  for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte(i) & 0x3f);
  text.remove_prefix(length);
  return static_cast<int>(code);
}

/// Calls each(glyph, x) for the glyphs of a line from x = 0 on [px]; returns where it ends.
template <class Each>
float lay_out(std::string_view text, float scale, const Each& each) {
  float x = 0;
  int before = 0;
  while (!text.empty()) {
    const int glyph = stbtt_FindGlyphIndex(&font(), next_character(text));
    if (before != 0) x += scale * static_cast<float>(stbtt_GetGlyphKernAdvance(&font(), before, glyph));
    each(glyph, x);
    int advance = 0;
    stbtt_GetGlyphHMetrics(&font(), glyph, &advance, nullptr);
    x += scale * static_cast<float>(advance);
    before = glyph;
  }
  return x;
}

void draw_glyph(Image& image, int glyph, float x, float baseline, float scale, const glm::vec3& srgb) {
  const float left = std::floor(x), top = std::floor(baseline);
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, x - left, baseline - top, &x0, &y0, &x1, &y1);
  const int width = x1 - x0, height = y1 - y0;
  if (width <= 0 || height <= 0) return;
  std::vector<unsigned char> ink(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  stbtt_MakeGlyphBitmapSubpixel(&font(), ink.data(), width, height, width, scale, scale, x - left, baseline - top,
                                glyph);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const int px = static_cast<int>(left) + x0 + i, py = static_cast<int>(top) + y0 + j;
      if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
      const float cover = static_cast<float>(ink[static_cast<std::size_t>(j * width + i)]) / 255;
      std::uint8_t* out = image.pixel(px, py);
      for (int c = 0; c < 3; ++c)
        out[c] = static_cast<std::uint8_t>(std::lround(glm::mix(static_cast<float>(out[c]), 255 * srgb[c], cover)));
      out[3] = static_cast<std::uint8_t>(std::max<long>(out[3], std::lround(255 * cover)));
    }
}

}  // namespace

float text_width(std::string_view text, float size) {
  return lay_out(text, stbtt_ScaleForPixelHeight(&font(), size), [](int, float) {});
}

void draw_text(Image& image, std::string_view text, float x, float baseline, float size, const glm::vec3& srgb) {
  const float scale = stbtt_ScaleForPixelHeight(&font(), size);
  lay_out(text, scale, [&](int glyph, float at) { draw_glyph(image, glyph, x + at, baseline, scale, srgb); });
}

}  // namespace softreel::render
