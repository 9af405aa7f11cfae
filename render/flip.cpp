#include "render/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "render/flip_color.h"
#include "render/flip_filters.h"
#include "render/flip_rows.h"

namespace softreel::render {

namespace {

/// Section 4.1.3: the part of the largest colour error below which errors are spread over most of the range.
constexpr float kColorExponent = 0.7f, kCompressFrom = 0.4f, kCompressTo = 0.95f;

/// Colour difference to the power 0.7, redistributed to 0..1.
float spread(float error) {
  static const float largest = largest_color_error();
  const float edge = kCompressFrom * largest;
  if (error < edge) return kCompressTo / edge * error;
  return kCompressTo + (error - edge) / (largest - edge) * (1 - kCompressTo);
}

float pixel_error(const SeenRow& r, const SeenRow& t, std::size_t x) {
  const float distance = hyab(r.l[x] - t.l[x], r.a[x] - t.a[x], r.b[x] - t.b[x]);
  if (distance == 0) return 0;
  const float color = spread(std::pow(distance, kColorExponent));
  const float features = std::max(std::abs(r.edge[x] - t.edge[x]), std::abs(r.point[x] - t.point[x]));
  const float feature = std::sqrt(features / std::numbers::sqrt2_v<float>);  // section 4.2: exponent 0.5
  return std::pow(color, 1 - feature);                                       // section 4.3
}

void fill_rows(const Image& reference, const Image& test, const FlipFilters& filters, int first, int end,
               FlipMap& map) {
  const auto width = static_cast<std::size_t>(map.width);
  SeenRows reference_rows(reference, filters, first), test_rows(test, filters, first);
  SeenRow r(map.width), t(map.width);
  for (int y = first; y < end; ++y) {
    reference_rows.next(r);
    test_rows.next(t);
    float* out = map.error.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x) out[x] = pixel_error(r, t, x);
  }
}

}  // namespace

double pixels_per_degree(double distance, double width, int pixels) {
  return distance * pixels / width * std::numbers::pi / 180;
}

FlipMap flip(const Image& reference, const Image& test, const FlipView& view, int threads) {
  if (reference.width != test.width || reference.height != test.height)
    throw std::invalid_argument("FLIP: two pictures of different sizes");
  if (!(view.pixels_per_degree > 0) || threads < 1) throw std::invalid_argument("FLIP: a setting that is not positive");
  FlipMap map;
  map.width = reference.width;
  map.height = reference.height;
  map.error.resize(reference.pixel_count());
  const FlipFilters filters = flip_filters(view.pixels_per_degree);
  const int strips = std::clamp(map.height / std::max(4 * filters.radius, 1), 1, threads);
  const auto start = [&](int strip) { return static_cast<int>(static_cast<long>(map.height) * strip / strips); };
  std::vector<std::jthread> others;
  for (int s = 1; s < strips; ++s)
    others.emplace_back([&, s] { fill_rows(reference, test, filters, start(s), start(s + 1), map); });
  fill_rows(reference, test, filters, 0, start(1), map);
  others.clear();

  double sum = 0;
  for (std::size_t i = 0; i < map.error.size(); ++i) {
    sum += static_cast<double>(map.error[i]);
    if (map.error[i] <= map.max) continue;
    map.max = map.error[i];
    map.max_x = static_cast<int>(i % static_cast<std::size_t>(map.width));
    map.max_y = static_cast<int>(i / static_cast<std::size_t>(map.width));
  }
  if (!map.error.empty()) map.mean = sum / static_cast<double>(map.error.size());
  return map;
}

}  // namespace softreel::render
