#include <cmath>
#include <nlohmann/json.hpp>

#include "app/compare_outputs.h"

namespace softreel::app {
namespace {

using Json = nlohmann::ordered_json;

const char* state_name(const FrameResult& f) {
  switch (f.state) {
    case FrameState::kMissing:
      return "missing";
    case FrameState::kExtra:
      return "no reference";
    case FrameState::kSkipped:
      return "not judged";
    case FrameState::kCompared:
      break;
  }
  return f.good ? "good" : "different";
}

Json frame_json(const FrameResult& f, const FramePair& pair) {
  Json json = {{"name", f.name}, {"state", state_name(f)}};
  if (!pair.reference.empty()) json["reference"] = pair.reference.string();
  if (!pair.actual.empty()) json["actual"] = pair.actual.string();
  if (!f.note.empty()) json["note"] = f.note;
  if (f.state != FrameState::kCompared) return json;
  const render::ImageDifference& d = f.difference;
  json["reached"] = f.good ? Json(std::string(render::rung_name(f.judgement.reached))) : Json(nullptr);
  if (!f.good) json["decided_by"] = f.judgement.limit;
  json["reference_size"] = {f.reference.width, f.reference.height};
  json["actual_size"] = {f.actual.width, f.actual.height};
  if (!d.same_size) return json;
  json["pixels"] = d.pixels;
  json["masked_pixels"] = f.masked_pixels;
  json["differing_pixels"] = d.differing_pixels;
  json["max_levels"] = d.max_levels;
  json["mean_levels"] = d.mean_levels;
  json["worst_pixel"] = {d.worst_x, d.worst_y};
  json["cluster"] = d.cluster;
  json["flicker_levels"] = f.flicker;
  if (f.flip)
    json["flip"] = {{"mean", f.flip->mean},
                    {"max", f.flip->max},
                    {"worst_pixel", {f.flip->max_x, f.flip->max_y}},
                    {"visible_pixels", f.flip->visible_pixels}};
  return json;
}

}  // namespace

std::string compare_json(const Comparison& c) {
  const ClipResult& clip = c.clip;
  const auto name = [&](int i) { return i < 0 ? Json(nullptr) : Json(clip.frames[static_cast<std::size_t>(i)].name); };
  Json json = {{"reference", c.reference},
               {"actual", c.actual},
               {"good", clip.good()},
               {"frames_that_differ", clip.bad},
               {"worst", name(clip.worst)},
               {"first_that_differs", name(clip.first_bad)},
               {"most_flicker", name(clip.most_flicker)}};
  if (std::isfinite(clip.flicker_limit)) json["flicker_limit_levels"] = clip.flicker_limit;
  for (const TimeShift& s : clip.shift)
    json["shift"] = {{"frames_late", s.frames}, {"good", s.good}, {"compared", s.all}};
  json["misplaced"] = Json::array();
  for (const Misplaced& m : clip.misplaced)
    json["misplaced"].push_back({{"frame", name(m.frame)}, {"shows", name(m.shows)}});
  json["frames"] = Json::array();
  for (std::size_t i = 0; i < clip.frames.size(); ++i) json["frames"].push_back(frame_json(clip.frames[i], c.pairs[i]));
  // File names need not be UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace softreel::app
