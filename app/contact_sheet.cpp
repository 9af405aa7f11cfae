#include "app/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/film.h"
#include "render/image_io.h"
#include "render/look.h"
#include "render/text.h"

namespace softreel::app {
namespace {

constexpr int kThumbWidth = 320, kGap = 8, kCaption = 20;  // [px]

std::array<float, 256> linear_table() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i)
    table[static_cast<std::size_t>(i)] = render::linear_from_srgb(glm::vec3(static_cast<float>(i) / 255)).x;
  return table;
}

/// Mean of the light over the pixels that fall into (x, y) of a picture of that size; over white where it is
/// transparent.
glm::vec3 mean_light(const render::Image& image, int x, int y, int width, int height) {
  static const std::array<float, 256> kLinear = linear_table();
  const int x0 = x * image.width / width, x1 = std::max((x + 1) * image.width / width, x0 + 1);
  const int y0 = y * image.height / height, y1 = std::max((y + 1) * image.height / height, y0 + 1);
  glm::vec3 sum(0);
  for (int v = y0; v < y1; ++v)
    for (int u = x0; u < x1; ++u) {
      const std::uint8_t* p = image.pixel(u, v);
      const float alpha = static_cast<float>(p[3]) / 255;
      sum += alpha * glm::vec3(kLinear[p[0]], kLinear[p[1]], kLinear[p[2]]) + (1 - alpha);
    }
  return sum / static_cast<float>((x1 - x0) * (y1 - y0));
}

void set(render::Image& sheet, int x, int y, const glm::vec3& light) {
  std::uint8_t* out = sheet.pixel(x, y);
  for (int c = 0; c < 3; ++c) out[c] = render::srgb_byte(light[c]);
  out[3] = 255;
}

}  // namespace

std::vector<SheetFrame> sheet_frames(const std::vector<SheetFrame>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<SheetFrame> chosen;
  for (std::size_t i = 0; i < most; ++i)
    chosen.push_back(frames[i * (frames.size() - 1) / std::max<std::size_t>(most - 1, 1)]);
  return chosen;
}

render::Image contact_sheet(const std::vector<SheetFrame>& frames) {
  const int count = static_cast<int>(frames.size());
  const int columns = std::min(count, count <= 6 ? 3 : 4), rows = (count + columns - 1) / columns;
  const render::Image first = render::load_image(frames.front().file);
  const int width = std::min(kThumbWidth, first.width);
  const int height =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(width) * first.height / first.width)));
  render::Image sheet = render::Image::blank(kGap + columns * (width + kGap), kGap + rows * (height + kCaption + kGap));
  std::fill(sheet.rgba.begin(), sheet.rgba.end(), std::uint8_t{255});
  for (int i = 0; i < count; ++i) {
    const SheetFrame& frame = frames[static_cast<std::size_t>(i)];
    const render::Image image = render::load_image(frame.file);
    const int left = kGap + i % columns * (width + kGap), top = kGap + i / columns * (height + kCaption + kGap);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) set(sheet, left + x, top + y, mean_light(image, x, y, width, height));
    render::draw_text(sheet, fmt::format("{:.2f} s", frame.time), static_cast<float>(left),
                      static_cast<float>(top + height + 15), 14, glm::vec3(0.15f));
  }
  return sheet;
}

}  // namespace softreel::app
