// softreel render SCENE
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/frame_range.h"
#include "app/hashes.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/stage.h"
#include "app/video.h"
#include "assets/error.h"
#include "render/frame_writer.h"
#include "render/png.h"

namespace softreel::app {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr const char* kHashKey = "softreel:frame_hash";
constexpr const char* kFrameKey = "softreel:frame";

bool up_to_date(const std::filesystem::path& file, const std::string& hash, int frame) {
  const std::optional<render::PngText> text = render::read_png_text(file);
  if (!text) return false;
  const auto has = [&](const char* key, const std::string& value) {
    const auto it = text->find(key);
    return it != text->end() && it->second == value;
  };
  return has(kHashKey, hash) && has(kFrameKey, std::to_string(frame));
}

/// What the cache still knows of a clip that was not touched in this run.
void read_figures(ClipPlan& plan) {
  for (int f = 1; f <= plan.frames.back(); ++f) {
    const std::optional<CachedFrame> data = plan.cache.read(f);
    if (!data) return;
    plan.figures.vertices = static_cast<long>(data->state.x.size()) / 3;
    plan.figures.per_frame.push_back(data->figures);
  }
}

CachedFrame must_read(const ClipCache& cache, int frame) {
  std::optional<CachedFrame> data = cache.read(frame);
  if (!data)
    throw assets::UserError(assets::ErrorKind::kInput, cache.folder().string(),
                            fmt::format("the cached state of frame {} went missing while rendering", frame));
  return std::move(*data);
}

void render_frames(ClipPlan& plan, const std::vector<int>& frames, bool quiet) {
  const bool whole = needs_whole_clip(plan.scene);
  const int last = whole ? plan.scene.time.frames() : frames.back();
  const Shapes shapes = simulate_plan(plan, last, quiet);
  const Clock::time_point start = Clock::now();
  ClipExtent extent;
  for (int f = 1; f <= last; ++f) {
    const CachedFrame data = must_read(plan.cache, f);
    plan.figures.per_frame.push_back(data.figures);
    if (whole) add_frame(plan.scene, shapes, data, extent);
  }
  // Frame 1 whichever frames are asked for, so that each looks the same in every selection.
  if (!whole) add_frame(plan.scene, shapes, must_read(plan.cache, 1), extent);
  Stage stage(plan.scene, shapes, extent);
  render::FrameWriter writer(1);
  {
    Progress progress("render", static_cast<int>(frames.size()), quiet);
    for (int f : frames) {
      if (interrupted()) break;
      const render::PngText text = {{kHashKey, plan.figures.frame_hash},
                                    {kFrameKey, std::to_string(f)},
                                    {"softreel:sim_hash", plan.figures.simulation_hash},
                                    {"Software", "softreel " + version()},
                                    {"softreel:driver", stage.renderer().driver()}};
      std::optional<CachedFrame> before;
      if (plan.scene.render.shutter > 0 && f > 1) before = must_read(plan.cache, f - 1);
      writer.write(plan.output / frame_file_name(f),
                   stage.draw(f, must_read(plan.cache, f), before ? &*before : nullptr), text);
      plan.figures.pictures.push_back(stage.renderer().last_picture());
      ++plan.figures.frames_rendered;
      progress.advance();
    }
  }
  writer.finish();
  plan.figures.render = since(start);
  plan.figures.counters = stage.renderer().counters();
  plan.figures.encode = writer.encode_seconds();
  stop_if_interrupted();
}

/// They are not ours to delete, but whoever makes a video of the folder should know.
void note_frames_of_a_longer_clip(const ClipPlan& plan, bool quiet) {
  const std::string next = frame_file_name(plan.scene.time.frames() + 1);
  std::error_code ignored;
  if (std::filesystem::exists(plan.output / next, ignored))
    say(quiet, fmt::format("note: {} (and what follows it) is of a longer clip and was left alone", next));
}

}  // namespace

int run_render(const ClipArguments& a) {
  const Clock::time_point start = Clock::now();
  if (!a.video.empty()) check_video(a.video);
  ClipPlan plan = plan_clip(a);
  plan.figures.frame_hash = frame_hash(plan.scene, plan.figures.simulation_hash);
  std::vector<int> stale;
  std::vector<std::filesystem::path> files;
  for (int f : plan.frames) {
    files.push_back(plan.output / frame_file_name(f));
    if (!up_to_date(files.back(), plan.figures.frame_hash, f)) stale.push_back(f);
  }
  plan.figures.frames_up_to_date = static_cast<int>(plan.frames.size() - stale.size());
  if (!stale.empty()) render_frames(plan, stale, a.quiet);
  if (!a.video.empty()) write_video(a.video, files, plan.scene.time.fps);
  plan.figures.total = since(start);
  if (!a.stats.empty()) {
    if (stale.empty()) read_figures(plan);
    write_stats(a.stats, plan.figures);
  }
  if (stale.empty())
    say(a.quiet, "every frame is up to date");
  else
    say(a.quiet, summary(plan.figures));
  note_frames_of_a_longer_clip(plan, a.quiet);
  if (!a.quiet) {
    fmt::print("{}\n", (plan.output / frame_file_name(plan.frames.front())).string());
    if (plan.frames.size() > 1) fmt::print("{}\n", files.back().string());
    if (!a.video.empty()) fmt::print("{}\n", a.video);
  }
  return kDone;
}

}  // namespace softreel::app
