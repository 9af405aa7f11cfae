#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "app/compare_outputs.h"
#include "render/png.h"

namespace softreel::app {
namespace {

std::string shift_line(const TimeShift& s) {
  const int frames = std::abs(s.frames);
  return fmt::format("shifted in time: the clip is {} frame{} {}; compared like that, {} of {} frames are good\n",
                     frames, frames == 1 ? "" : "s", s.frames > 0 ? "late" : "early", s.good, s.all);
}

std::string misplaced_lines(const ClipResult& clip) {
  constexpr int kShown = 10;
  const auto name = [&](int i) { return clip.frames[static_cast<std::size_t>(i)].name; };
  std::map<int, int> shows;
  for (const Misplaced& m : clip.misplaced) shows[m.frame] = m.shows;
  std::string text;
  int shown = 0;
  for (const auto& [frame, other] : shows) {
    if (++shown > kShown) break;
    const auto back = shows.find(other);
    const bool swapped = back != shows.end() && back->second == frame;
    if (swapped && other < frame) continue;
    text += swapped ? fmt::format("swapped: {} and {}\n", name(frame), name(other))
                    : fmt::format("in the wrong place: {} shows what belongs to {}\n", name(frame), name(other));
  }
  if (shown > kShown) text += fmt::format("and {} more frames in the wrong place\n", shows.size() - kShown);
  return text;
}

}  // namespace

std::string closing_lines(const Comparison& c) {
  const ClipResult& clip = c.clip;
  const auto at = [&](int i) -> const FrameResult& { return clip.frames[static_cast<std::size_t>(i)]; };
  if (clip.frames.size() == 1 && at(0).state == FrameState::kCompared) return describe(at(0)) + "\n";
  std::string text;
  if (clip.worst >= 0) text += fmt::format("worst: {}: {}\n", at(clip.worst).name, describe(at(clip.worst)));
  if (clip.bad > 0) text += fmt::format("first that differs: {}\n", at(clip.first_bad).name);
  if (clip.most_flicker >= 0) {
    text += fmt::format("flicker: at most {:.3g} levels, from the frame before to {}", at(clip.most_flicker).flicker,
                        at(clip.most_flicker).name);
    text += clip.flicker_too_much ? fmt::format("; at most {:.3g} allowed\n", clip.flicker_limit) : "\n";
  }
  for (const TimeShift& s : clip.shift) text += shift_line(s);
  if (clip.shift.empty()) text += misplaced_lines(clip);
  return text + fmt::format("{} of {} frames differ\n", clip.bad, clip.frames.size());
}

std::vector<TextDifference> picture_texts(const FramePair& pair) {
  std::map<std::string, TextDifference> texts;
  const auto add = [&](const std::filesystem::path& file, std::string TextDifference::*side) {
    if (file.empty()) return;
    if (const std::optional<render::PngText> found = render::read_png_text(file))
      for (const auto& [key, value] : *found) texts[key].*side = value;
  };
  add(pair.reference, &TextDifference::reference);
  add(pair.actual, &TextDifference::actual);
  std::vector<TextDifference> list;
  for (auto& [key, text] : texts) {
    text.key = key;
    list.push_back(text);
  }
  return list;
}

}  // namespace softreel::app
