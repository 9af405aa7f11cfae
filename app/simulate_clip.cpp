#include "app/simulate_clip.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "app/clip_world.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/run_watch.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

/// `last`: the last frame that held.
[[noreturn]] void give_up(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& last, int frame,
                          const StepFailure& failure) {
  const std::string what_to_do =
      scene.time.integrator == "static"
          ? "more time.substeps make the load grow in smaller parts; solver.max_iterations allows more of them"
      : failure.halved
          ? "more time.substeps, softer materials or slower motions help; time.max_halvings allows more halving"
          : fmt::format(
                "raise time.substeps (to {}, say), soften the materials, or take time.integrator = "
                "\"implicit-euler\", which has no stability limit",
                scene.time.substeps + scene.time.substeps / 2 + 1);
  const Cause cause = likely_cause(scene, shapes, last);
  throw assets::UserError(
      assets::ErrorKind::kSimulation, scene.file.string(),
      fmt::format("the simulation failed on the way to frame {} (t = {:.4g} s): {}{}. Frames 1 to {} are kept; {}{}",
                  frame, (frame - 1) / scene.time.fps, failure.why,
                  failure.halved ? fmt::format(", also with the step halved {} times", scene.time.max_halvings) : "",
                  frame - 1, cause.text, cause.advises ? "" : what_to_do));
}

}  // namespace

ClipRun simulate_clip(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache, int last, bool quiet) {
  const auto start = std::chrono::steady_clock::now();
  ClipRun run;
  ClipWorld world(scene, shapes);
  run.vertices = world.vertices();

  RunWatch watch(scene, shapes);
  int frame = 0;
  std::optional<CachedFrame> from;  // the last frame that held
  while (frame < last) {
    std::optional<CachedFrame> next = cache.read(frame + 1, run.vertices);
    if (!next || next->fields.size() != scene.fields.size()) break;
    from = std::move(next);
    watch.look(*from);
    ++frame;
  }
  run.frames_from_cache = frame;
  if (from && frame < last) {
    world.restore(*from);
    say(quiet, fmt::format("frames 1 to {} are simulated already; going on from there", frame));
  }
  if (frame == 0) {
    from = world.frame({});
    watch.look(*from);
    cache.write(1, *from);
    frame = 1;
    run.frames_simulated = 1;
  }
  {
    Progress progress("simulate", last - frame, quiet);
    for (++frame; frame <= last; ++frame) {
      sim::StepReport sum;
      for (int step = 0; step < scene.time.substeps; ++step) {
        stop_if_interrupted();
        if (const auto failure = world.step(scene.time.step(), sum)) give_up(scene, shapes, *from, frame, *failure);
      }
      CachedFrame now = world.frame(sum);
      if (const auto why = watch.look(now)) give_up(scene, shapes, *from, frame, {*why});
      cache.write(frame, now);
      from = std::move(now);
      ++run.frames_simulated;
      run.total.add(sum);
      progress.advance();
    }
  }
  run.solver = run.total.solver;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace softreel::app
