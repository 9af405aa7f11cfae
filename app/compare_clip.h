#pragma once
// A whole clip against its reference: every frame, and what only shows in the row of them.
#include <string>
#include <vector>

#include "app/compare_frame.h"

namespace softreel::app {

/// The actual clip is the reference, some frames later (or earlier).
struct TimeShift {
  int frames = 0;         ///< > 0: late
  int good = 0, all = 0;  ///< of the frames that overlap, those that are good at that shift
};

/// A frame that shows what belongs to another one, pixel by pixel.
struct Misplaced {
  int frame = 0, shows = 0;  ///< indices into ClipResult::frames
};

struct ClipResult {
  std::vector<FrameResult> frames;
  int bad = 0;     ///< frames that differ, are missing or have no reference
  int worst = -1;  ///< indices into frames; -1: none
  int first_bad = -1;
  int most_flicker = -1;  ///< -1: nowhere
  bool flicker_too_much = false;
  double flicker_limit = 0;      ///< infinite: none
  std::vector<TimeShift> shift;  ///< none or one
  std::vector<Misplaced> misplaced;
  bool good() const { return bad == 0 && !flicker_too_much; }
};

/// Frames are read as they are needed: memory does not grow with their number (but for figures). One line a frame is
/// printed as soon as it is known, if `each`. Throws UserError, RenderError, Interrupted.
ClipResult compare_clip(const std::vector<FramePair>& pairs, const CompareRules& rules, int threads, bool each,
                        bool quiet);

/// "frame_0007.png: driver: 12 of 921600 pixels (0.0013 %), at most 2 levels (at 10, 20)", and so on: what there is to
/// say of a frame.
std::string describe(const FrameResult& frame);

}  // namespace softreel::app
