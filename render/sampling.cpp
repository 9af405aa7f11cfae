#include "render/sampling.h"

#include <cmath>
#include <numbers>

namespace softreel::render {

namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// Mixes all bits (the finalizer of MurmurHash3).
std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

std::uint32_t combine(std::uint32_t seed, std::uint32_t dimension) {
  return hash(seed + 0x9e3779b9u * (dimension + 1));
}

/// Every bit is flipped by a hash of the bits below it only (S. Laine and T. Karras, "Stratified Sampling for
/// Stochastic Transparency", EGSR 2011; constants by Burley).
std::uint32_t permute_upwards(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(permute_upwards(reverse_bits(x), seed));
}

/// Second dimension of Sobol's sequence; the first is the bit reversal.
std::uint32_t sobol_second(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1)
    if ((index & 1u) != 0) result ^= direction;
  return result;
}

float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// Inverse of the tent's distribution on [-1, 1].
float tent(float u) { return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)); }

}  // namespace

glm::vec2 sobol_point(std::uint32_t index, std::uint32_t seed) {
  // The order is shuffled as well, so that dimensions padded together do not march in step.
  const std::uint32_t shuffled = owen_scramble(index, combine(seed, 0));
  return {unit_float(owen_scramble(reverse_bits(shuffled), combine(seed, 1))),
          unit_float(owen_scramble(sobol_second(shuffled), combine(seed, 2)))};
}

glm::vec2 disc_from_square(const glm::vec2& square) {
  const glm::vec2 p = 2.0f * square - 1.0f;
  if (p.x == 0 && p.y == 0) return {0, 0};
  constexpr float kQuarter = std::numbers::pi_v<float> / 4;
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float radius = wide ? p.x : p.y;
  const float angle = wide ? kQuarter * (p.y / p.x) : 2 * kQuarter - kQuarter * (p.x / p.y);
  return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

std::vector<PassSample> pass_samples(int count, std::size_t light_count, std::uint32_t seed) {
  std::vector<PassSample> passes(static_cast<std::size_t>(count));
  for (PassSample& pass : passes) pass.lights.assign(light_count, glm::vec2(0.5f));
  if (count == 1) return passes;
  constexpr std::uint32_t kFirstLight = 2, kLens = 1000, kTime = 1001;  // dimensions: each its own scrambling
  for (std::uint32_t i = 0; i < passes.size(); ++i) {
    const glm::vec2 pixel = sobol_point(i, combine(seed, 0));
    passes[i].pixel = {tent(pixel.x), tent(pixel.y)};
    passes[i].sky = sobol_point(i, combine(seed, 1));
    passes[i].lens = disc_from_square(sobol_point(i, combine(seed, kLens)));
    passes[i].time = sobol_point(i, combine(seed, kTime)).x;
    for (std::uint32_t light = 0; light < light_count; ++light)
      passes[i].lights[light] = sobol_point(i, combine(seed, kFirstLight + light));
  }
  return passes;
}

}  // namespace softreel::render
