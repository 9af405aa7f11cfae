#pragma once
// One frame against its reference.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/compare_rules.h"
#include "app/frame_pairs.h"
#include "render/compare_images.h"
#include "render/tolerance.h"

namespace softreel::app {

/// A picture small enough to keep one of every frame: mean luminance of 16 x 9 blocks, 0..255.
inline constexpr int kThumbnailWidth = 16, kThumbnailHeight = 9;
using Thumbnail = std::array<float, kThumbnailWidth * kThumbnailHeight>;

struct FrameSide {
  int width = 0, height = 0;  ///< [px]
  std::string pixel_hash;     ///< equal for equal pixels, however they are compressed
  Thumbnail thumbnail{};
};

enum class FrameState { kCompared, kMissing, kExtra, kSkipped };

struct FrameResult {
  std::string name;
  int number = -1;
  FrameState state = FrameState::kCompared;
  bool good = false;
  render::Judgement judgement;
  render::ImageDifference difference;
  std::optional<render::FlipFigures> flip;  ///< where the perceptual rung was reached
  std::size_t masked_pixels = 0;
  /// How much the difference changed since the frame before: mean over the pixels of |d - d_before|, d the signed
  /// difference of luminance [levels]. 0 in the first frame, and for a constant difference.
  double flicker = 0;
  FrameSide reference, actual;
  std::string note;  ///< what the reader should know besides
};

/// A result, and what the next frame needs of it.
struct FrameWork {
  FrameResult result;
  std::vector<std::int16_t> change;  ///< actual - reference, luminance in 1/64 levels; empty: no difference, or no pair
};

/// Loads and judges. `ids`: picture of body ids, empty if there is none. `threads`: for this one frame. Throws
/// RenderError (kInput) for pictures that are none.
FrameWork compare_frame(const FramePair& pair, const FrameRule& rule, const std::filesystem::path& ids,
                        double pixels_per_degree, int threads);

/// The picture of a pair's difference (render/difference_picture.h), without what is masked. Both files are there.
render::Image picture_of_difference(const FramePair& pair, const FrameRule& rule, const std::filesystem::path& ids);

/// The picture of the body ids of a frame; empty where the rule asks for none.
std::filesystem::path ids_of(const CompareRules& rules, const FrameRule& rule, const std::string& name);

/// Mean of |a - b| over the pixels [levels]; an empty one counts as zero everywhere, other sizes as no flicker.
double flicker_between(const std::vector<std::int16_t>& a, const std::vector<std::int16_t>& b);

/// Worse first: what is bad before what is good, another size before figures, then FLIP, levels and pixels.
bool is_worse(const FrameResult& a, const FrameResult& b);

}  // namespace softreel::app
