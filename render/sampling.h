#pragma once
// The sample points of the accumulation passes: one stratified, seeded sequence for all features.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace softreel::render {

/// What one pass draws.
struct PassSample {
  glm::vec2 pixel{0};  ///< offset from the pixel's centre [px], already distributed as the pixel filter (a tent, -1..1)
  std::vector<glm::vec2> lights;  ///< per light: point in the unit square
  glm::vec2 sky{0.5f};            ///< point in the unit square
  glm::vec2 lens{0};              ///< point on the unit disc
  float time = 1;                 ///< of the shutter: 0 it opens .. 1 it closes
};

/// Point `index` of the (0,2)-sequence of Sobol, Owen-scrambled by `seed`: every aligned block of 2^k points is
/// stratified in all elementary intervals (B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). In [0,
/// 1)^2.
glm::vec2 sobol_point(std::uint32_t index, std::uint32_t seed);

/// From the unit square to the unit disc, area kept, neighbours kept (P. Shirley and K. Chiu, "A Low Distortion Map
/// Between Disk and Square", J. Graphics Tools 2(3), 1997).
glm::vec2 disc_from_square(const glm::vec2& square);

/// All passes of a picture. One pass looks through the middle of everything as the shutter closes; the same arguments
/// give the same points, and fewer passes are the beginning of more (but for one alone).
std::vector<PassSample> pass_samples(int count, std::size_t light_count, std::uint32_t seed);

}  // namespace softreel::render
