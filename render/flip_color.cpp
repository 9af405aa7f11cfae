#include "render/flip_color.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/glm.hpp>

namespace softreel::render {

namespace {

/// Columns: XYZ of full red, green and blue, over XYZ of white, so that white is (1, 1, 1).
glm::dmat3 white_scaled_xyz_from_rgb() {
  constexpr double kX[4] = {0.64, 0.30, 0.15, 0.31271}, kY[4] = {0.33, 0.60, 0.06, 0.32902};  // red, green, blue, white
  const auto xyz = [&](int i) { return glm::dvec3(kX[i] / kY[i], 1, (1 - kX[i] - kY[i]) / kY[i]); };
  const glm::dmat3 primaries(xyz(0), xyz(1), xyz(2));
  const glm::dvec3 luminances = glm::inverse(primaries) * xyz(3);
  glm::dmat3 result;
  for (int c = 0; c < 3; ++c) result[c] = primaries[c] * luminances[c] / xyz(3);
  return result;
}

using Matrix = std::array<float, 9>;  // row by row: plain floats vectorize

Matrix row_by_row(const glm::dmat3& m) {
  Matrix result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result[static_cast<std::size_t>(3 * r + c)] = static_cast<float>(m[c][r]);
  return result;
}

const Matrix& xyz_from_rgb() {
  static const Matrix kMatrix = row_by_row(white_scaled_xyz_from_rgb());
  return kMatrix;
}
const Matrix& rgb_from_xyz() {
  static const Matrix kMatrix = row_by_row(glm::inverse(white_scaled_xyz_from_rgb()));
  return kMatrix;
}

/// IEC 61966-2-1, 5.2.
const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> kTable = [] {
    std::array<float, 256> table;
    for (std::size_t i = 0; i < 256; ++i) {
      const double v = static_cast<double>(i) / 255;
      table[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return table;
  }();
  return kTable;
}

/// For t >= 0; within two units in the last place. Unlike std::cbrt the compiler vectorizes it: a third of the exponent
/// by the integer that the float is, then Halley's iteration twice (each triples the correct digits).
inline float cube_root(float t) {
  float y = std::bit_cast<float>(std::bit_cast<std::int32_t>(t) / 3 + 0x2a514067);
  for (int i = 0; i < 2; ++i) {
    const float cube = y * y * y;
    y *= (cube + 2 * t) / (2 * cube + t);
  }
  return y;
}

/// CIE 15:2004, 8.2.1.1.
inline float lab_curve(float t) {
  constexpr float kEdge = 216.0f / 24389, kSlope = 24389.0f / 27 / 116, kOffset = 16.0f / 116;
  const float root = cube_root(t);
  return t > kEdge ? root : kSlope * t + kOffset;
}

inline float clamped(float v) { return std::min(std::max(v, 0.0f), 1.0f); }

}  // namespace

void to_opponent(const std::uint8_t* rgba, int width, const OpponentRows& out) {
  const std::array<float, 256>& linear = linear_of_byte();
  const Matrix m = xyz_from_rgb();
  for (int x = 0; x < width; ++x, rgba += 4) {
    unsigned c[3] = {rgba[0], rgba[1], rgba[2]};
    if (rgba[3] != 255)
      for (unsigned& v : c) v = (v * rgba[3] + 128u * (255u - rgba[3]) + 127u) / 255u;
    const float r = linear[c[0]], g = linear[c[1]], b = linear[c[2]];
    const float big_x = m[0] * r + m[1] * g + m[2] * b;
    const float big_y = m[3] * r + m[4] * g + m[5] * b;
    const float big_z = m[6] * r + m[7] * g + m[8] * b;
    out.luminance[x] = big_y;
    out.cx[x] = 500 * (big_x - big_y);
    out.cz[x] = 200 * (big_y - big_z);
  }
}

void to_hunt_lab(int width, const OpponentRows& rows) {
  const Matrix m = rgb_from_xyz(), n = xyz_from_rgb();
  float* __restrict luminance = rows.luminance;
  float* __restrict cx = rows.cx;
  float* __restrict cz = rows.cz;
  for (int i = 0; i < width; ++i) {
    const float y = luminance[i], x = y + cx[i] / 500, z = y - cz[i] / 200;
    const float r = clamped(m[0] * x + m[1] * y + m[2] * z);
    const float g = clamped(m[3] * x + m[4] * y + m[5] * z);
    const float b = clamped(m[6] * x + m[7] * y + m[8] * z);
    const float fx = lab_curve(n[0] * r + n[1] * g + n[2] * b);
    const float fy = lab_curve(n[3] * r + n[4] * g + n[5] * b);
    const float fz = lab_curve(n[6] * r + n[7] * g + n[8] * b);
    const float l = 116 * fy - 16, hunt = 0.01f * l;
    luminance[i] = l;
    cx[i] = hunt * 500 * (fx - fy);
    cz[i] = hunt * 200 * (fy - fz);
  }
}

float largest_color_error() {
  static const float kError = [] {
    const std::uint8_t pixels[8] = {0, 255, 0, 255, 0, 0, 255, 255};
    float l[2], a[2], b[2];
    const OpponentRows rows{l, a, b};
    to_opponent(pixels, 2, rows);
    to_hunt_lab(2, rows);
    return std::pow(hyab(l[0] - l[1], a[0] - a[1], b[0] - b[1]), 0.7f);
  }();
  return kError;
}

}  // namespace softreel::render
