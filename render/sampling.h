#pragma once
// The sample points of the accumulation passes: one stratified, seeded sequence for all features.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace softreel::render {

/// What one pass draws. Lens and shutter get their places here when they come.
struct PassSample {
  glm::vec2 pixel{0};  ///< offset from the pixel's centre [px], already distributed as the pixel filter (a tent, -1..1)
  std::vector<glm::vec2> lights;  ///< per light: point on the unit disc
  glm::vec2 sky{0};               ///< point on the unit disc, under the hemisphere: cosine distributed
};

/// Point `index` of the (0,2)-sequence of Sobol, Owen-scrambled by `seed`: every aligned block of 2^k points is
/// stratified in all elementary intervals (B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). In [0,
/// 1)^2.
glm::vec2 sobol_point(std::uint32_t index, std::uint32_t seed);

/// From the unit square to the unit disc, area kept, neighbours kept (P. Shirley and K. Chiu, "A Low Distortion Map
/// Between Disk and Square", J. Graphics Tools 2(3), 1997).
glm::vec2 disc_from_square(const glm::vec2& square);

/// All passes of a picture. One pass looks through the middle of everything; the same arguments give the same points.
std::vector<PassSample> pass_samples(int count, std::size_t light_count, std::uint32_t seed);

}  // namespace softreel::render
