#include "app/compare_shift.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "app/interrupt.h"
#include "app/ordered_work.h"

namespace softreel::app {
namespace {

constexpr int kLongest = 48;  // [frames]

/// Mean distance of the thumbnails of actual frames from those of the references `shift` before; < 0: no two overlap.
double distance_at(const std::vector<FrameResult>& frames, int shift) {
  double sum = 0;
  int count = 0;
  const int n = static_cast<int>(frames.size());
  for (int i = std::max(shift, 0); i < std::min(n, n + shift); ++i) {
    const FrameSide& actual = frames[static_cast<std::size_t>(i)].actual;
    const FrameSide& reference = frames[static_cast<std::size_t>(i - shift)].reference;
    if (actual.width == 0 || reference.width == 0) continue;
    for (std::size_t k = 0; k < actual.thumbnail.size(); ++k)
      sum += static_cast<double>(std::abs(actual.thumbnail[k] - reference.thumbnail[k]));
    ++count;
  }
  return count == 0 ? -1 : sum / (count * static_cast<double>(Thumbnail{}.size()));
}

}  // namespace

std::vector<Misplaced> misplaced_frames(const std::vector<FrameResult>& frames) {
  std::map<std::string, std::vector<int>> by_pixels;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (!frames[i].reference.pixel_hash.empty())
      by_pixels[frames[i].reference.pixel_hash].push_back(static_cast<int>(i));
  std::vector<Misplaced> found;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].good || frames[i].actual.pixel_hash.empty()) continue;
    const auto it = by_pixels.find(frames[i].actual.pixel_hash);
    if (it == by_pixels.end()) continue;
    const int here = static_cast<int>(i);
    // Of several equal references the nearest: clips stand still.
    const int nearest = *std::min_element(it->second.begin(), it->second.end(),
                                          [&](int a, int b) { return std::abs(a - here) < std::abs(b - here); });
    found.push_back({here, nearest});
  }
  return found;
}

int likely_shift(const std::vector<FrameResult>& frames) {
  const int longest = std::min(kLongest, static_cast<int>(frames.size()) / 4);
  const double now = distance_at(frames, 0);
  int best = 0;
  double least = now;
  for (int length = 1; length <= longest; ++length)
    for (const int shift : {length, -length}) {
      const double distance = distance_at(frames, shift);
      if (distance < 0 || distance >= least) continue;
      least = distance;
      best = shift;
    }
  // Half as far: a change that stays, such as another light, is as far at every shift.
  return now > 0 && least < 0.5 * now ? best : 0;
}

TimeShift check_shift(const std::vector<FramePair>& pairs, const CompareRules& rules, int shift, int threads) {
  std::vector<FramePair> shifted;
  const int n = static_cast<int>(pairs.size());
  for (int i = std::max(shift, 0); i < std::min(n, n + shift); ++i) {
    FramePair pair = pairs[static_cast<std::size_t>(i)];
    pair.reference = pairs[static_cast<std::size_t>(i - shift)].reference;
    if (!pair.reference.empty() && !pair.actual.empty()) shifted.push_back(std::move(pair));
  }
  TimeShift result{shift, 0, static_cast<int>(shifted.size())};
  ordered_work(
      result.all, threads,
      [&](int i) {
        const FramePair& pair = shifted[static_cast<std::size_t>(i)];
        FrameRule rule = rules.rule_for(pair.name, pair.number);
        rule.ids.clear();  // they are those of the frame's own time
        return compare_frame(pair, rule, {}, rules.pixels_per_degree(), 1).result.good;
      },
      [&](int, bool good) {
        stop_if_interrupted();
        result.good += good;
      });
  return result;
}

}  // namespace softreel::app
