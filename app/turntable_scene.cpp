#include "app/turntable_scene.h"

#include <fmt/format.h>

#include <charconv>

#include "app/clip_run.h"
#include "app/progress.h"
#include "app/stage.h"
#include "app/turntable_pictures.h"
#include "assets/error.h"

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
  clip.output = turntable_output(a).string();
  ClipPlan plan = plan_clip(clip);
  const int number = frame_number(a.frame, plan.scene.time.frames());
  const Shapes shapes = simulate_plan(plan, number, a.quiet);
  const std::optional<CachedFrame> frame = plan.cache.read(number);
  if (!frame)
    throw assets::UserError(assets::ErrorKind::kInput, plan.cache.folder().string(), "a cached frame went missing");
  ClipExtent extent;
  add_frame(plan.scene, shapes, *frame, extent);
  Stage stage(plan.scene, shapes, extent);
  for (const std::string& note : stage.notes()) say(a.quiet, "note: " + note);
  const glm::vec3 axis = extent.bounds.empty() ? glm::vec3(0) : extent.bounds.centre();
  const auto fov = static_cast<float>(plan.scene.camera.fov);
  const render::Camera first =
      render::frame_turntable(extent.points, axis, fov, static_cast<float>(a.size[0]) / static_cast<float>(a.size[1]));
  return write_turntable(a, plan.output, stage.renderer().driver(), [&](double angle) {
    return stage.draw_from(*frame, render::orbit(first, axis, static_cast<float>(angle)));
  });
}

}  // namespace softreel::app
