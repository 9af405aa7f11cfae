// softreel render SCENE
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/contact_sheet.h"
#include "app/exit_code.h"
#include "app/frame_range.h"
#include "app/hashes.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/render_jobs.h"
#include "app/stage.h"
#include "app/video.h"
#include "assets/error.h"
#include "render/channels.h"
#include "render/frame_writer.h"
#include "render/png.h"
#include "render/png16.h"

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

/// Side channels that the scene asks for, beside the frame.
void write_channels(const ClipPlan& plan, Stage& stage, int frame, const render::PngText& text) {
  const assets::Render& r = plan.scene.render;
  if (!r.depth && !r.normal && !r.id) return;
  const render::Channels channels = stage.channels();
  const auto file = [&](const char* name) { return plan.output / fmt::format("{}_{:04}.png", name, frame); };
  const auto write = [&](const char* name, int count, const std::vector<std::uint16_t>& samples) {
    render::write_png16(file(name), channels.width, channels.height, count, samples, text);
  };
  if (r.depth) write("depth", 1, render::depth_samples(channels));
  if (r.normal) write("normal", 3, render::normal_samples(channels));
  if (r.id) write("id", 1, channels.id);
}

void render_frames(const ClipArguments& a, ClipPlan& plan, const std::vector<int>& frames) {
  const bool whole = needs_whole_clip(plan.scene);
  const int last = whole ? plan.scene.time.frames() : frames.back();
  const Shapes shapes = simulate_plan(plan, last, a.quiet);
  const Clock::time_point start = Clock::now();
  if (a.jobs > 1 && frames.size() > 1) {
    render_in_jobs(a, frames);
    plan.figures.frames_rendered = static_cast<int>(frames.size());
    plan.figures.render = since(start);
    read_figures(plan);
    return;
  }
  ClipExtent extent;
  for (int f = 1; f <= last; ++f) {
    const CachedFrame data = must_read(plan.cache, f);
    plan.figures.per_frame.push_back(data.figures);
    if (whole) add_frame(plan.scene, shapes, data, extent);
  }
  // Frame 1 whichever frames are asked for, so that each looks the same in every selection.
  if (!whole) add_frame(plan.scene, shapes, must_read(plan.cache, 1), extent);
  Stage stage(plan.scene, shapes, extent);
  for (const std::string& note : stage.notes()) say(a.quiet, "note: " + note);
  render::FrameWriter writer(1);
  {
    Progress progress("render", static_cast<int>(frames.size()), a.quiet);
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
      write_channels(plan, stage, f, text);
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

void write_sheet(const ClipPlan& plan, const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t kMost = 12;
  std::vector<SheetFrame> frames;
  for (std::size_t i = 0; i < files.size(); ++i)
    frames.push_back({files[i], (plan.frames[i] - 1) / plan.scene.time.fps});
  render::write_png(plan.output / "sheet.png", contact_sheet(sheet_frames(frames, kMost)));
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
  if (!stale.empty()) render_frames(a, plan, stale);
  if (!a.video.empty()) write_video(a.video, files, plan.scene.time.fps);
  if (a.sheet) write_sheet(plan, files);
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
    if (a.sheet) fmt::print("{}\n", (plan.output / "sheet.png").string());
    if (!a.video.empty()) fmt::print("{}\n", a.video);
  }
  return kDone;
}

}  // namespace softreel::app
