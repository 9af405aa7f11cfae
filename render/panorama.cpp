#include "render/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sampling.h"

namespace softreel::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kWidest = 1024;  // of the map: finer detail shows in no reflection that a frame resolves

float luminance(const glm::vec3& c) { return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// x and y in 0..1 of the picture.
glm::vec3 direction_at(double x, double y) {
  const double longitude = 2 * kPi * (x - 0.5), polar = kPi * y;
  return {static_cast<float>(std::sin(longitude) * std::sin(polar)), static_cast<float>(std::cos(polar)),
          static_cast<float>(-std::cos(longitude) * std::sin(polar))};
}

/// Solid angle of one pixel of row y.
double solid_angle(int y, int width, int height) {
  return 2 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
}

std::array<float, 9> harmonics(const glm::vec3& n) {
  return {0.282095f,
          0.488603f * n.y,
          0.488603f * n.z,
          0.488603f * n.x,
          1.092548f * n.x * n.y,
          1.092548f * n.y * n.z,
          0.315392f * (3 * n.z * n.z - 1),
          1.092548f * n.x * n.z,
          0.546274f * (n.x * n.x - n.y * n.y)};
}

/// Mean over the pixels of a block each; shifted by `turn` of a full turn.
std::vector<glm::vec3> resized(const std::vector<glm::vec3>& in, int width, int height, int new_width, int new_height,
                               double turn = 0) {
  std::vector<glm::vec3> out(static_cast<std::size_t>(new_width) * static_cast<std::size_t>(new_height));
  for (int y = 0; y < new_height; ++y)
    for (int x = 0; x < new_width; ++x) {
      const int y0 = y * height / new_height, y1 = std::max((y + 1) * height / new_height, y0 + 1);
      const auto column = [&](int at) {
        const double shifted = static_cast<double>(at) / new_width + turn;
        return static_cast<int>(std::floor(shifted * width + 1e-6));
      };
      const int x0 = column(x), x1 = std::max(column(x + 1), x0 + 1);
      glm::dvec3 sum(0);
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          sum += glm::dvec3(in[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(((u % width) + width) % width)]);
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(new_width) + static_cast<std::size_t>(x)] =
          glm::vec3(sum / static_cast<double>((y1 - y0) * (x1 - x0)));
    }
  return out;
}

glm::vec3 texel_at(const std::vector<glm::vec3>& pixels, int width, int height, const glm::vec3& d) {
  const double x = 0.5 + std::atan2(static_cast<double>(d.x), static_cast<double>(-d.z)) / (2 * kPi);
  const double y = std::acos(std::clamp(static_cast<double>(d.y), -1.0, 1.0)) / kPi;
  const int u = std::clamp(static_cast<int>(x * width), 0, width - 1);
  const int v = std::clamp(static_cast<int>(y * height), 0, height - 1);
  return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
}

/// Mean of what a GGX surface of that roughness mirrors when it is seen along its normal `n`.
glm::vec3 blurred(const std::vector<glm::vec3>& pixels, int width, int height, const glm::vec3& n, float roughness) {
  constexpr std::uint32_t kRays = 64;
  const float alpha2 = std::pow(roughness, 4.0f);
  const glm::vec3 helper = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(helper, n)), v = glm::cross(n, u);
  glm::vec3 sum(0);
  float weights = 0;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const glm::vec2 s = sobol_point(i, 17);
    const float cos_h = std::sqrt((1 - s.x) / (1 + (alpha2 - 1) * s.x));
    const float sin_h = std::sqrt(std::max(1 - cos_h * cos_h, 0.0f));
    const float angle = 2 * std::numbers::pi_v<float> * s.y;
    const glm::vec3 h = sin_h * (std::cos(angle) * u + std::sin(angle) * v) + cos_h * n;
    const glm::vec3 l = 2 * glm::dot(n, h) * h - n;
    const float weight = glm::dot(n, l);
    if (weight <= 0) continue;
    sum += weight * texel_at(pixels, width, height, l);
    weights += weight;
  }
  return sum / std::max(weights, 1e-6f);
}

}  // namespace

Panorama::Panorama(const HdrImage& image, float strength, float turn) {
  // All levels halve evenly.
  const int width = std::clamp((image.width + 31) / 32 * 32, 64, kWidest), height = width / 2;
  std::vector<glm::vec3> pixels =
      resized(image.pixels, image.width, image.height, width, height, static_cast<double>(turn) / 360);
  for (glm::vec3& p : pixels) p *= strength;
  take_out_sun(pixels, width, height);

  std::array<glm::dvec3, 9> sums{};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 light =
          glm::dvec3(pixels[static_cast<std::size_t>(y * width + x)]) * solid_angle(y, width, height);
      const std::array<float, 9> basis = harmonics(direction_at((x + 0.5) / width, (y + 0.5) / height));
      for (std::size_t k = 0; k < 9; ++k) sums[k] += light * static_cast<double>(basis[k]);
    }
  // The cosine lobe's own coefficients over pi: 1, 2/3, 1/4.
  for (std::size_t k = 0; k < 9; ++k) irradiance_[k] = glm::vec3(sums[k] * (k == 0 ? 1.0 : k < 4 ? 2.0 / 3 : 0.25));

  // Rays are few: they look at means of about the size that each of them stands for.
  int w = width, h = height;
  for (int level = 0; level < kLevels; ++level, w = std::max(w / 2, 1), h = std::max(h / 2, 1)) {
    Level out{w, h, {}};
    const std::vector<glm::vec3> base = resized(pixels, width, height, w, h);
    const float roughness = static_cast<float>(level) / (kLevels - 1);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const glm::vec3 n = direction_at((x + 0.5) / w, (y + 0.5) / h);
        const glm::vec3 value =
            level == 0 ? base[static_cast<std::size_t>(y * w + x)] : blurred(base, w, h, n, roughness);
        out.texels.emplace_back(value, 1);
      }
    levels_.push_back(std::move(out));
  }

  width_ = 128;
  height_ = 64;
  grid_ = resized(pixels, width, height, width_, height_);
  row_cdf_.assign(1, 0);
  for (int y = 0; y < height_; ++y) {
    double sum = 0;
    column_cdf_.push_back(0);
    for (int x = 0; x < width_; ++x) {
      const double weight = static_cast<double>(luminance(grid_[static_cast<std::size_t>(y * width_ + x)])) + 1e-9;
      column_cdf_.push_back(sum += weight * solid_angle(y, width_, height_));
    }
    row_cdf_.push_back(row_cdf_.back() + sum);
  }
}

Panorama::Sample Panorama::sample(const glm::vec2& square) const {
  // From a running sum to the cell that a number falls into, and how far into it.
  const auto pick = [](const double* cdf, int count, double u) {
    const double at = u * cdf[count];
    const int cell = std::clamp(static_cast<int>(std::upper_bound(cdf, cdf + count + 1, at) - cdf) - 1, 0, count - 1);
    const double width = cdf[cell + 1] - cdf[cell];
    return cell + std::clamp(width > 0 ? (at - cdf[cell]) / width : 0.5, 0.0, 1.0);
  };
  const double y = std::min(pick(row_cdf_.data(), height_, static_cast<double>(square.y)), height_ - 1e-6);
  const int row = static_cast<int>(y);
  const double x = std::min(
      pick(column_cdf_.data() + static_cast<std::ptrdiff_t>(row) * (width_ + 1), width_, static_cast<double>(square.x)),
      width_ - 1e-6);
  const glm::vec3 color = grid_[static_cast<std::size_t>(row * width_ + static_cast<int>(x))];
  const double total = row_cdf_.back();
  return {direction_at(x / width_, y / height_), color / (luminance(color) + 1e-9f) * static_cast<float>(total / kPi)};
}

void Panorama::take_out_sun(std::vector<glm::vec3>& pixels, int width, int height) {
  const auto for_each = [&](const auto& visit) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        visit(pixels[static_cast<std::size_t>(y * width + x)], solid_angle(y, width, height),
              direction_at((x + 0.5) / width, (y + 0.5) / height));
  };
  double total = 0;
  for_each(
      [&](const glm::vec3& p, double angle, const glm::vec3&) { total += static_cast<double>(luminance(p)) * angle; });
  // Brighter than this many times the mean is no sky and no wall.
  const float limit = static_cast<float>(30 * total / (4 * kPi));
  if (!(limit > 0)) return;
  glm::dvec3 excess(0), mean(0);
  double bright = 0;
  for_each([&](const glm::vec3& p, double angle, const glm::vec3& d) {
    const float l = luminance(p);
    if (l <= limit) return;
    const glm::dvec3 over = glm::dvec3(p) * (1 - static_cast<double>(limit / l)) * angle;
    excess += over;
    mean += glm::dvec3(d) * static_cast<double>(luminance(glm::vec3(over)));
    bright += static_cast<double>(luminance(glm::vec3(over)));
  });
  // A cap of half-angle a has a mean of length (1 + cos a) / 2; beyond 20 degrees it is no single spot.
  constexpr double kWidestSpot = 20;
  if (bright < 0.1 * total) return;
  const double cosine = 2 * glm::length(mean) / bright - 1;
  const double half = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / kPi;
  if (half > kWidestSpot) return;
  for (glm::vec3& p : pixels)
    if (const float l = luminance(p); l > limit) p *= limit / l;
  Light sun = sun_light(-glm::vec3(glm::normalize(mean)), static_cast<float>(std::max(2 * half, 0.53)));
  const double strongest = std::max({excess.x, excess.y, excess.z});
  sun.color = glm::vec3(excess / strongest);
  sun.intensity = static_cast<float>(strongest / kPi);
  sun_ = sun;
}

}  // namespace softreel::render
