#include "render/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "render/color_map.h"
#include "render/text.h"

namespace softreel::render {

namespace {

constexpr glm::vec3 kInk(0.11f, 0.12f, 0.14f);
constexpr glm::vec3 kPaper(0.97f, 0.97f, 0.97f);
constexpr float kPaperCover = 0.80f;

/// All lengths in pixels. Text grows slower than the picture: on a large one small letters are read as well.
struct Sizes {
  float text, label, bar, gap, tick, margin, pad, height;
  explicit Sizes(int picture_height) {
    const auto h = static_cast<float>(picture_height);
    text = std::max(6.0f, 6.5f + 0.0155f * h);
    label = 1.08f * text;
    bar = std::round(std::max(3.0f, 0.95f * text));
    gap = std::round(0.45f * text);
    tick = std::max(2.0f, std::round(0.3f * text));
    margin = std::round(0.9f * text);
    pad = std::round(0.75f * text);
    height = std::round(0.46f * h);
  }
};

std::string superscript(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

struct Layout {
  Ticks ticks;
  std::string title;
  float left, top, right, bottom;  // of the panel
  BarPlace bar;
};

Layout lay_out(int height, const ColorBar& bar, float right) {
  const Sizes s(height);
  Layout l;
  l.ticks = nice_ticks(bar.low, bar.high, static_cast<int>(std::clamp(s.height / (2.6f * s.text), 2.0f, 7.0f)));
  l.title = bar.label;
  if (!l.ticks.factor.empty()) l.title += (l.title.empty() ? "" : " ") + l.ticks.factor;
  float labels = 0;
  for (const std::string& text : l.ticks.labels) labels = std::max(labels, text_width(text, s.text));
  const float content = std::max(s.bar + s.tick + s.gap + labels, text_width(l.title, s.label));
  const float title = l.title.empty() ? 0.5f * s.text : 1.75f * s.label;
  l.right = right - s.margin;
  l.left = std::floor(l.right - content - 2 * s.pad);
  const float whole = s.height + title + 2 * s.pad;
  l.top = std::round(0.5f * (static_cast<float>(height) - whole));
  l.bottom = l.top + whole;
  l.bar.left = static_cast<int>(l.left + s.pad);
  l.bar.right = l.bar.left + static_cast<int>(s.bar);
  l.bar.top = static_cast<int>(l.top + s.pad + title);
  l.bar.bottom = l.bar.top + static_cast<int>(s.height);
  return l;
}

void blend(Image& image, int x, int y, const glm::vec3& srgb, float cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || cover <= 0) return;
  std::uint8_t* out = image.pixel(x, y);
  for (int c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(std::lround(glm::mix(static_cast<float>(out[c]), 255 * srgb[c], cover)));
  out[3] = static_cast<std::uint8_t>(std::max<long>(out[3], std::lround(255 * cover)));
}

/// With round corners.
void draw_panel(Image& image, const Layout& l, float radius) {
  const glm::vec2 middle(0.5f * (l.left + l.right), 0.5f * (l.top + l.bottom));
  const glm::vec2 half(0.5f * (l.right - l.left) - radius, 0.5f * (l.bottom - l.top) - radius);
  for (int y = static_cast<int>(l.top) - 1; y <= static_cast<int>(l.bottom) + 1; ++y)
    for (int x = static_cast<int>(l.left) - 1; x <= static_cast<int>(l.right) + 1; ++x) {
      const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float out = glm::length(glm::max(glm::abs(at - middle) - half, 0.0f)) - radius;
      blend(image, x, y, kPaper, kPaperCover * std::clamp(0.5f - out, 0.0f, 1.0f));
    }
}

void draw(Image& image, const ColorBar& bar, const Layout& l) {
  const Sizes s(image.height);
  draw_panel(image, l, 0.5f * s.text);
  const BarPlace& b = l.bar;
  const ColorMap& map = color_maps()[bar.map];
  const auto rows = static_cast<float>(b.bottom - b.top);
  for (int y = b.top; y < b.bottom; ++y) {
    const glm::vec3 color = color_at(map, (static_cast<float>(b.bottom - y) - 0.5f) / rows);
    for (int x = b.left; x < b.right; ++x) blend(image, x, y, color, 1);
  }
  const float thick = std::max(1.0f, std::round(s.text / 14));
  for (std::size_t i = 0; i < l.ticks.values.size(); ++i) {
    const double t = (l.ticks.values[i] - bar.low) / (bar.high - bar.low);
    const float y = static_cast<float>(b.bottom) - static_cast<float>(t) * rows;
    const int first = static_cast<int>(
        std::clamp(std::round(y - 0.5f * thick), static_cast<float>(b.top), static_cast<float>(b.bottom) - thick));
    for (int row = first; row < first + static_cast<int>(thick); ++row)
      for (int x = b.right; x < b.right + static_cast<int>(s.tick); ++x) blend(image, x, row, kInk, 1);
    // A third of the letters' height below the middle: digits are then centred.
    draw_text(image, l.ticks.labels[i], static_cast<float>(b.right) + s.tick + s.gap, std::round(y + 0.32f * s.text),
              s.text, kInk);
  }
  draw_text(image, l.title, l.left + s.pad, std::round(l.top + s.pad + 0.8f * s.label), s.label, kInk);
}

std::vector<Layout> layouts(int width, int height, std::span<const ColorBar> bars) {
  std::vector<Layout> all;
  auto right = static_cast<float>(width);
  for (const ColorBar& bar : bars) {
    all.push_back(lay_out(height, bar, right));
    right = all.back().left;
  }
  return all;
}

}  // namespace

Ticks nice_ticks(double low, double high, int wanted) {
  Ticks ticks;
  if (!(high > low) || !std::isfinite(high - low)) return ticks;
  // The finest of 1, 2, 5 x 10^k that gives no more than wanted + 1 ticks.
  const double rough = (high - low) / std::max(wanted, 1);
  int power = static_cast<int>(std::floor(std::log10(rough)));
  const double leading = rough / std::pow(10.0, power);
  int factor = leading <= 1 ? 1 : leading <= 2 ? 2 : leading <= 5 ? 5 : 10;
  if (factor == 10) {
    factor = 1;
    ++power;
  }
  const double slack = 1e-9 * (high - low);
  double step = 0;
  const auto count = [&] { return std::floor((high + slack) / step) - std::ceil((low - slack) / step) + 1; };
  for (step = factor * std::pow(10.0, power); count() < 2; step = factor * std::pow(10.0, power)) {
    // One number says nothing about the scale.
    power -= factor == 1;
    factor = factor == 1 ? 5 : factor / 2;
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  const int magnitude = static_cast<int>(std::floor(std::log10(largest)));
  const int common = magnitude >= 5 || magnitude < -2 ? magnitude : 0;
  if (common != 0) ticks.factor = "×10" + superscript(common);
  const int digits = std::max(0, common - power);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    const double value = k * step;
    ticks.values.push_back(value);
    std::string label = fmt::format("{:.{}f}", value / std::pow(10.0, common), digits);
    if (k == 0 && label[0] == '-') label.erase(0, 1);
    if (label[0] == '-') label.replace(0, 1, "−");
    ticks.labels.push_back(std::move(label));
  }
  return ticks;
}

void draw_color_bars(Image& image, std::span<const ColorBar> bars) {
  const std::vector<Layout> all = layouts(image.width, image.height, bars);
  for (std::size_t i = 0; i < all.size(); ++i) draw(image, bars[i], all[i]);
}

int color_bars_width(int width, int height, std::span<const ColorBar> bars) {
  return bars.empty() ? 0 : width - static_cast<int>(layouts(width, height, bars).back().left);
}

std::vector<BarPlace> color_bar_places(int width, int height, std::span<const ColorBar> bars) {
  std::vector<BarPlace> places;
  for (const Layout& l : layouts(width, height, bars)) places.push_back(l.bar);
  return places;
}

}  // namespace softreel::render
