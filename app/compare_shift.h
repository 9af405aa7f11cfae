#pragma once
// A shift in time is not a change in the picture: tells them apart.
#include <vector>

#include "app/compare_clip.h"

namespace softreel::app {

/// Frames that show another frame's pixels, where that one's are found exactly.
std::vector<Misplaced> misplaced_frames(const std::vector<FrameResult>& frames);

/// The shift at which the thumbnails fit best, if they fit clearly better than without one: nothing is proven yet.
/// Returns 0 for none. At most a quarter of the clip, at most 48 frames.
int likely_shift(const std::vector<FrameResult>& frames);

/// Compares every actual frame with the reference `shift` frames before it (> 0: the clip is late).
TimeShift check_shift(const std::vector<FramePair>& pairs, const CompareRules& rules, int shift, int threads);

}  // namespace softreel::app
