#include "render/tolerance.h"

#include <fmt/format.h>

#include <array>

namespace softreel::render {

namespace {

double part(std::size_t some, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(some) / static_cast<double>(all);
}

/// The first limit that does not hold; empty if all do. What weighs most comes first.
std::string broken_limit(const ImageDifference& d, const DriverLimits& limits) {
  if (d.max_levels > limits.levels) return fmt::format("{} levels, at most {} allowed", d.max_levels, limits.levels);
  if (d.differing_fraction() > limits.pixels)
    return fmt::format("{:.3g} % of the pixels, at most {:.3g} % allowed", 100 * d.differing_fraction(),
                       100 * limits.pixels);
  if (d.cluster > limits.cluster)
    return fmt::format("a cluster at {}, {} with {:.0f} % of its pixels, at most {:.0f} % allowed", d.cluster_x,
                       d.cluster_y, 100 * d.cluster, 100 * limits.cluster);
  return {};
}

std::string broken_limit(const FlipFigures& f, const PerceptualLimits& limits) {
  if (f.mean > limits.mean) return fmt::format("FLIP {:.4f}, at most {:.4g} allowed", f.mean, limits.mean);
  if (part(f.visible_pixels, f.pixels) > limits.visible)
    return fmt::format("{:.3g} % of the pixels visibly (FLIP above {:.2g}), at most {:.3g} % allowed",
                       100 * part(f.visible_pixels, f.pixels), static_cast<double>(kVisibleError),
                       100 * limits.visible);
  return {};
}

}  // namespace

std::string_view rung_name(Rung rung) {
  constexpr std::array<std::string_view, kRungs> kNames{"bytes", "pixels", "driver", "perceptual"};
  return kNames[static_cast<std::size_t>(rung)];
}

Judgement judge(const ImageDifference& d, bool same_bytes, const FlipFigures* flip, const Tolerance& tolerance) {
  if (same_bytes) return {true, Rung::kBytes, {}};
  if (tolerance.rung == Rung::kBytes) return {false, Rung::kPixels, "the files differ, the same bytes were asked for"};
  if (!d.same_size) return {false, Rung::kPixels, "different sizes"};
  if (d.differing_pixels == 0) return {true, Rung::kPixels, {}};
  if (tolerance.rung == Rung::kPixels)
    return {false, Rung::kPixels, fmt::format("{} pixels differ, the same pixels were asked for", d.differing_pixels)};
  const std::string driver = broken_limit(d, tolerance.driver);
  if (driver.empty()) return {true, Rung::kDriver, {}};
  if (tolerance.rung == Rung::kDriver || flip == nullptr) return {false, Rung::kDriver, driver};
  const std::string perceptual = broken_limit(*flip, tolerance.perceptual);
  return {perceptual.empty(), Rung::kPerceptual, perceptual};
}

}  // namespace softreel::render
