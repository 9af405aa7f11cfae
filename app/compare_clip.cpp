#include "app/compare_clip.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/compare_shift.h"
#include "app/interrupt.h"
#include "app/ordered_work.h"
#include "app/progress.h"

namespace softreel::app {
namespace {

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

/// A clip is late when it fits the reference some frames before; only frames that are there on both sides tell.
void tell_shift(const std::vector<FramePair>& pairs, const CompareRules& rules, int threads, ClipResult& clip) {
  const int shift = likely_shift(clip.frames);
  if (shift == 0) return;
  const TimeShift found = check_shift(pairs, rules, shift, threads);
  int good_now = 0;
  for (const FrameResult& f : clip.frames) good_now += f.state == FrameState::kCompared && f.good;
  if (2 * found.good > found.all && found.good > good_now) clip.shift.push_back(found);
}

}  // namespace

std::string describe(const FrameResult& f) {
  switch (f.state) {
    case FrameState::kMissing:
      return "missing";
    case FrameState::kExtra:
      return "has no reference";
    case FrameState::kSkipped:
      return "not judged" + (f.note.empty() ? "" : ": " + f.note);
    case FrameState::kCompared:
      break;
  }
  const render::ImageDifference& d = f.difference;
  if (!d.same_size)
    return fmt::format("different: {} x {} pixels, the reference has {} x {}", f.actual.width, f.actual.height,
                       f.reference.width, f.reference.height);
  if (f.good && f.judgement.reached == render::Rung::kBytes) return "same bytes";
  std::string text = f.good ? (f.judgement.reached == render::Rung::kPixels
                                   ? "same pixels"
                                   : fmt::format("within {}", render::rung_name(f.judgement.reached)))
                            : "different";
  if (d.differing_pixels > 0)
    text += fmt::format(": {} of {} pixels ({}), at most {} level{} (at {}, {}), mean {:.3g}", d.differing_pixels,
                        d.pixels, percent(d.differing_fraction()), d.max_levels, d.max_levels == 1 ? "" : "s",
                        d.worst_x, d.worst_y, d.mean_levels);
  if (f.flip) text += fmt::format(", FLIP {:.4f}", f.flip->mean);
  if (!f.good) text += fmt::format("; decided by: {}", f.judgement.limit);
  if (f.masked_pixels > 0) text += fmt::format("; {} pixels masked", f.masked_pixels);
  if (!f.note.empty()) text += fmt::format(" ({})", f.note);
  return text;
}

ClipResult compare_clip(const std::vector<FramePair>& pairs, const CompareRules& rules, int threads, bool each,
                        bool quiet) {
  ClipResult clip;
  clip.flicker_limit = rules.flicker_limit();
  const int count = static_cast<int>(pairs.size());
  std::vector<std::int16_t> before;
  std::optional<Progress> progress;
  if (count > 1) progress.emplace("compare", count, quiet);
  const auto work = [&](int i) {
    const FramePair& pair = pairs[static_cast<std::size_t>(i)];
    const FrameRule rule = rules.rule_for(pair.name, pair.number);
    return compare_frame(pair, rule, ids_of(rules, rule, pair.name), rules.pixels_per_degree(),
                         count == 1 ? threads : 1);
  };
  ordered_work(count, threads, work, [&](int i, FrameWork&& done) {
    stop_if_interrupted();
    FrameResult& f = done.result;
    if (i > 0) f.flicker = flicker_between(before, done.change);
    before = std::move(done.change);
    if (!f.good) {
      ++clip.bad;
      if (clip.first_bad < 0) clip.first_bad = i;
    }
    if (count > 1 && (each || !f.good)) fmt::print("{}: {}\n", f.name, describe(f));
    clip.frames.push_back(std::move(f));
    const auto at = [&](int k) -> const FrameResult& { return clip.frames[static_cast<std::size_t>(k)]; };
    if (clip.worst < 0 || is_worse(at(i), at(clip.worst))) clip.worst = i;
    if (at(i).flicker > 0 && (clip.most_flicker < 0 || at(i).flicker > at(clip.most_flicker).flicker))
      clip.most_flicker = i;
    if (progress) progress->advance();
  });
  progress.reset();
  clip.flicker_too_much =
      clip.most_flicker >= 0 && clip.frames[static_cast<std::size_t>(clip.most_flicker)].flicker > clip.flicker_limit;
  if (clip.bad > 0 && count > 1) {
    clip.misplaced = misplaced_frames(clip.frames);
    tell_shift(pairs, rules, threads, clip);
  }
  return clip;
}

}  // namespace softreel::app
