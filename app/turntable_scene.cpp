#include "app/turntable_scene.h"

#include <fmt/format.h>

#include <charconv>

#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/frame_range.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/stage.h"
#include "app/video.h"
#include "assets/error.h"
#include "render/frame_writer.h"

namespace softreel::app {
namespace {

int frame_number(const std::string& text, int last) {
  if (text == "last") return last;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1 || number > last)
    throw assets::UserError(assets::ErrorKind::kUsage,
                            fmt::format("--frame {}: expected a number from 1 to {}, or last", text, last));
  return number;
}

}  // namespace

int run_turntable_scene(const TurntableArguments& a) {
  ClipArguments clip;
  clip.scene = a.mesh;
  clip.overrides = a.overrides;
  clip.overrides.push_back(fmt::format("render.size=[{}, {}]", a.size[0], a.size[1]));
  clip.overrides.push_back(fmt::format("render.samples={}", a.samples));
  clip.quiet = a.quiet;
  clip.threads = a.threads;
  clip.output =
      a.output.empty()
          ? (std::filesystem::path("out") / (std::filesystem::path(a.mesh).stem().string() + "-turntable")).string()
          : a.output;
  if (!a.video.empty()) check_video(a.video);
  ClipPlan plan = plan_clip(clip);
  const int number = frame_number(a.frame, plan.scene.time.frames());
  const Shapes shapes = simulate_plan(plan, number, a.quiet);
  const std::optional<CachedFrame> frame = plan.cache.read(number);
  if (!frame)
    throw assets::UserError(assets::ErrorKind::kInput, plan.cache.folder().string(), "a cached frame went missing");
  ClipExtent extent;
  add_frame(plan.scene, shapes, *frame, extent);
  Stage stage(plan.scene, shapes, extent);
  const glm::vec3 axis = extent.bounds.empty() ? glm::vec3(0) : extent.bounds.centre();
  const auto fov = static_cast<float>(plan.scene.camera.fov);
  const render::Camera first =
      render::frame_turntable(extent.points, axis, fov, static_cast<float>(a.size[0]) / static_cast<float>(a.size[1]));
  render::FrameWriter writer(1);
  std::vector<std::filesystem::path> files;
  {
    Progress progress("turntable", a.count, a.quiet);
    for (int i = 0; i < a.count && !interrupted(); ++i) {
      files.push_back(plan.output / frame_file_name(i + 1));
      // Picture `count` would be picture 0 again.
      const float angle = 360.0f * static_cast<float>(i) / static_cast<float>(a.count);
      writer.write(files.back(), stage.draw_from(*frame, render::orbit(first, axis, angle)),
                   {{"Software", "softreel " + version()}, {"softreel:frame", std::to_string(i + 1)}});
      progress.advance();
    }
  }
  writer.finish();
  stop_if_interrupted();
  if (!a.video.empty()) write_video(a.video, files, a.fps);
  if (!a.quiet) fmt::print("{}\n{}\n", files.front().string(), a.video.empty() ? files.back().string() : a.video);
  return kDone;
}

}  // namespace softreel::app
