#pragma once
// The ladder: what two pictures may differ by and still count as the same. Each rung forgives more than the one above.
#include <string>
#include <string_view>

#include "render/compare_images.h"
#include "render/flip.h"

namespace softreel::render {

enum class Rung {
  kBytes,       ///< the files are the same
  kPixels,      ///< the pixels are
  kDriver,      ///< what another driver does to a few pixels: DriverLimits
  kPerceptual,  ///< what a person who alternates between them hardly sees: PerceptualLimits
};
inline constexpr int kRungs = 4;

/// At most these, each of them.
struct DriverLimits {
  double pixels = 0.001;  ///< of all pixels, that differ at all; 0..1
  int levels = 3;         ///< of 255, in any channel
  /// Of a window of kClusterWindow x kClusterWindow pixels, that differ. An edge that falls a pixel further differs
  /// along a line: at most 2 * 16 * sqrt(2) = 45 of 256 pixels, both of its sides counted, and two such lines cross
  /// seldom. A small thing that is new fills its window.
  double cluster = 0.25;
};

struct PerceptualLimits {
  double mean = 0.01;      ///< FLIP, mean of the picture
  double visible = 0.002;  ///< of all pixels, with an error above kVisibleError; 0..1
};

struct Tolerance {
  Rung rung = Rung::kDriver;  ///< the last one that counts as good
  DriverLimits driver;
  PerceptualLimits perceptual;
};

struct Judgement {
  bool good = false;
  Rung reached = Rung::kDriver;  ///< the first rung that holds; without meaning if none up to tolerance.rung does
  std::string limit;  ///< which limit decided, in words: "4 levels, at most 3 allowed"; empty where nothing differs
};

/// "bytes", "pixels", "driver", "perceptual".
std::string_view rung_name(Rung rung);

/// `same_bytes`: of the files; `flip`: needed where tolerance.rung is kPerceptual and pixels differ, else null.
Judgement judge(const ImageDifference& difference, bool same_bytes, const FlipFigures* flip,
                const Tolerance& tolerance);

}  // namespace softreel::render
