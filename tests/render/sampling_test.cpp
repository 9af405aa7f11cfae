#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>

#include "render/sampling.h"

using namespace softreel::render;

TEST_CASE("every aligned block of 2^k points has one point in each elementary interval") {
  for (std::uint32_t seed = 0; seed < 20; ++seed)
    for (const std::uint32_t count : {4u, 16u, 64u})
      for (std::uint32_t columns = 1; columns <= count; columns *= 2) {
        const std::uint32_t rows = count / columns;
        std::set<std::uint32_t> cells;
        for (std::uint32_t i = 0; i < count; ++i) {
          const glm::vec2 p = sobol_point(count + i, seed);
          cells.insert(static_cast<std::uint32_t>(p.x * static_cast<float>(columns)) * rows +
                       static_cast<std::uint32_t>(p.y * static_cast<float>(rows)));
        }
        CHECK(cells.size() == count);
      }
}

TEST_CASE("the sequence measures edges better than random points, already with four") {
  // Coverage of a half plane through the unit square: the integrand of an edge, or of a penumbra.
  std::mt19937 bits(1);
  const auto unit = [&] { return static_cast<float>(bits()) * 0x1p-32f; };
  for (const int count : {4, 16, 64}) {
    double stratified = 0;
    double random = 0;
    constexpr int kTrials = 3000;
    for (int trial = 0; trial < kTrials; ++trial) {
      const float angle = 6.2831853f * unit();
      const glm::vec2 normal(std::cos(angle), std::sin(angle));
      const auto covered = [&](const glm::vec2& p) { return glm::dot(p - 0.5f, normal) > 0 ? 1.0 : 0.0; };
      double a = 0;
      double b = 0;
      for (int i = 0; i < count; ++i) {
        a += covered(sobol_point(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(trial)));
        b += covered({unit(), unit()});
      }
      // The edge runs through the middle: exactly one half is covered.
      stratified += (a / count - 0.5) * (a / count - 0.5);
      random += (b / count - 0.5) * (b / count - 0.5);
    }
    // Random points have variance 1 / (4 N), stratified ones fall with N^-1.5: 2, 4, 8 times better at least.
    CHECK(random / kTrials == doctest::Approx(0.25 / count).epsilon(0.15));
    CHECK(stratified * std::sqrt(count) < random);
  }
}

TEST_CASE("fewer passes are the beginning of more, in every dimension, and dimensions do not march in step") {
  const std::vector<PassSample> few = pass_samples(4, 2, 7), many = pass_samples(64, 2, 7);
  for (std::size_t i = 0; i < few.size(); ++i) {
    CHECK(few[i].pixel == many[i].pixel);
    CHECK(few[i].lights == many[i].lights);
    CHECK(few[i].lens == many[i].lens);
    CHECK(few[i].time == many[i].time);
  }
  // Independent dimensions have a correlation of at most 3 / sqrt(64) in all but one case of 400.
  double correlation = 0;
  for (const PassSample& s : many)
    correlation += (static_cast<double>(s.time) - 0.5) * (static_cast<double>(s.lights[0].x) - 0.5);
  CHECK(std::abs(correlation / 64 * 12) < 3 / std::sqrt(64.0));
  CHECK(many[5].lights[0] != many[5].lights[1]);
}

TEST_CASE("one pass looks through the middle of everything") {
  const std::vector<PassSample> passes = pass_samples(1, 2, 99);
  REQUIRE(passes.size() == 1);
  CHECK(passes[0].pixel == glm::vec2(0));
  REQUIRE(passes[0].lights.size() == 2);
  CHECK(passes[0].lights[1] == glm::vec2(0.5f));
  CHECK(passes[0].lens == glm::vec2(0));
  CHECK(passes[0].time == 1);
}

TEST_CASE("samples follow their distributions: tent in the pixel, uniform on discs") {
  const std::vector<PassSample> passes = pass_samples(1024, 1, 5);
  double pixel2 = 0;
  double disc2 = 0;
  glm::dvec2 mean(0);
  for (const PassSample& pass : passes) {
    CHECK(std::max(std::abs(pass.pixel.x), std::abs(pass.pixel.y)) <= 1);
    CHECK(glm::length(pass.lens) <= 1.000001f);
    pixel2 += pass.pixel.x * pass.pixel.x / 1024;
    disc2 += glm::dot(pass.lens, pass.lens) / 1024;
    mean += glm::dvec2(pass.pixel) / 1024.0;
  }
  CHECK(pixel2 == doctest::Approx(1.0 / 6).epsilon(0.02));
  CHECK(disc2 == doctest::Approx(0.5).epsilon(0.02));
  CHECK(glm::length(mean) < 0.01);
}

TEST_CASE("the seed decides the samples, and nothing else") {
  const auto a = pass_samples(8, 1, 1);
  const auto b = pass_samples(8, 1, 1);
  const auto c = pass_samples(8, 1, 2);
  for (std::size_t i = 0; i < 8; ++i) CHECK(a[i].pixel == b[i].pixel);
  CHECK(a[0].pixel != c[0].pixel);
}
