#pragma once
// Colour spaces of FLIP, a row at a time: sRGB bytes -> linearized opponent space, and from there to Hunt-adjusted
// CIELab. The matrix follows from the primaries of sRGB (IEC 61966-2-1) and the white point D65 (x = 0.31271, y =
// 0.32902).
#include <cmath>
#include <cstdint>

namespace softreel::render {

/// Rows of one picture, `width` values each. Yy is luminance Y / Yn: 116 Y/Yn - 16 without the constants, which filters
/// of sum 1 leave alone and derivatives remove. Cx = 500 (X/Xn - Y/Yn), Cz = 200 (Y/Yn - Z/Zn).
struct OpponentRows {
  float *luminance, *cx, *cz;
};

/// `rgba`: 4 bytes a pixel; transparent pixels lie on mid grey.
void to_opponent(const std::uint8_t* rgba, int width, const OpponentRows& out);

/// In place: luminance, Cx, Cz -> clamped to the sRGB gamut -> L*, a* and b*, the last two times 0.01 L*
/// (section 4.1.3: the Hunt effect).
void to_hunt_lab(int width, const OpponentRows& rows);

/// |dL| + sqrt(da^2 + db^2), section 4.1.3, from differences of two pixels of such rows.
inline float hyab(float dl, float da, float db) { return std::abs(dl) + std::sqrt(da * da + db * db); }

/// The distance between pure green and pure blue, the largest that the paper counts with, to the power 0.7.
float largest_color_error();

}  // namespace softreel::render
