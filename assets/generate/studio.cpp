#include "assets/generate/studio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "assets/atomic_file.h"

namespace softreel::generate {
namespace {

using Rgb = std::array<double, 3>;

struct Box {
  double longitude, latitude;  // of its middle [deg]; longitude 0 is -z, 90 is +x
  double width, height;        // [deg]
  Rgb light;
};

constexpr std::array<Box, 3> kBoxes = {
    {{215, 48, 70, 38, {7.5, 6.9, 6.1}}, {125, 25, 34, 52, {2.2, 2.6, 3.2}}, {0, 30, 90, 12, {4.0, 4.0, 4.2}}}};

/// 1 inside, 0 outside, with a soft rim of 4 degrees.
double cover(const Box& box, double longitude, double latitude) {
  const double aside = std::remainder(longitude - box.longitude, 360), above = latitude - box.latitude;
  const auto edge = [](double at, double half) { return std::clamp((half - std::abs(at)) / 4 + 0.5, 0.0, 1.0); };
  return edge(aside, box.width / 2) * edge(above, box.height / 2);
}

/// G. Ward, "Real Pixels", Graphics Gems II, 1991.
void add_rgbe(std::string& out, const Rgb& c) {
  int exponent = 0;
  const double scale = std::frexp(std::max({c[0], c[1], c[2]}), &exponent);
  const double factor = scale * 256 / std::max({c[0], c[1], c[2]});
  for (double v : c) out += static_cast<char>(static_cast<unsigned char>(v * factor));
  out += static_cast<char>(static_cast<unsigned char>(exponent + 128));
}

}  // namespace

void write_studio(const std::filesystem::path& file) {
  constexpr int kWidth = 128, kHeight = 64;
  std::string out =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(kHeight) + " +X " + std::to_string(kWidth) + "\n";
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double longitude = 360 * ((x + 0.5) / kWidth - 0.5), latitude = 90 - 180 * (y + 0.5) / kHeight;
      const double up = std::sin(latitude * std::numbers::pi / 180);
      const double wall = up > 0 ? 0.22 + 0.16 * up : 0.22 + 0.06 * up;
      Rgb c = {wall, wall, 1.04 * wall};
      for (const Box& box : kBoxes)
        for (size_t k = 0; k < 3; ++k) c[k] += cover(box, longitude, latitude) * box.light[k];
      add_rgbe(out, c);
    }
  assets::write_file_atomically(file, out);
}

}  // namespace softreel::generate
