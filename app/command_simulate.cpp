// softreel simulate SCENE
#include <fmt/format.h>

#include <chrono>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/export_clip.h"
#include "app/progress.h"

namespace softreel::app {

int run_simulate(const ClipArguments& a) {
  const auto start = std::chrono::steady_clock::now();
  ClipPlan plan = plan_clip(a);
  const int last = plan.frames.back();
  const Shapes shapes = simulate_plan(plan, last, a.quiet);
  if (!a.export_format.empty())
    export_clip(plan.scene, shapes, plan.cache, plan.frames, a.export_format, plan.output / "export");
  for (int f = 1; f <= last; ++f)
    if (const auto data = plan.cache.read(f)) plan.figures.per_frame.push_back(data->figures);
  plan.figures.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!a.stats.empty()) write_stats(a.stats, plan.figures);
  if (plan.figures.simulated)
    say(a.quiet, summary(plan.figures));
  else
    say(a.quiet, "every frame is simulated already");
  if (!a.quiet) fmt::print("{}\n", plan.cache.folder().string());
  return kDone;
}

}  // namespace softreel::app
