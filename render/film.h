#pragma once
// From light to picture: exposure, tone curve, background, sRGB. On the CPU, for the same bits everywhere.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/image.h"

namespace softreel::render {

struct Environment;

/// Linear radiance, rows from top to bottom, premultiplied by alpha: alpha is how much of the pixel is not background.
struct FloatImage {
  int width = 0;                ///< [px]
  int height = 0;               ///< [px]
  std::vector<glm::vec4> rgba;  ///< width * height
  /// What is drawn in the picture's own (display) linear colours, fields above all: width * height, premultiplied by
  /// its own alpha, or empty. The tone curve leaves it alone.
  std::vector<glm::vec4> display = {};
};

/// Khronos PBR Neutral tone curve (Khronos Group, "PBR Neutral Tone Mapper", 2024): colours below 0.76 stay as they are
/// but for a small toe, brighter ones are compressed and lose saturation instead of turning hue. In: linear >= 0; out:
/// 0..1 linear.
glm::vec3 tone_curve(const glm::vec3& radiance);

/// sRGB byte (IEC 61966-2-1) nearest to a linear value; values outside 0..1 are clamped.
std::uint8_t srgb_byte(float linear);

/// Exposure and tone curve on what was drawn, over the environment's background.
Image develop(const FloatImage& film, const Environment& environment);

}  // namespace softreel::render
