#include "app/simulate_clip.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <stdexcept>

#include "app/field_world.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/world.h"
#include "assets/error.h"
#include "sim/field.h"

namespace softreel::app {
namespace {

[[noreturn]] void give_up(const assets::Scene& scene, int frame, const std::string& what, const sim::StepReport& report,
                          bool implicit) {
  const std::string what_to_do =
      scene.time.integrator == "static"
          ? "more time.substeps make the load grow in smaller parts; solver.max_iterations allows more of them"
      : implicit
          ? "more time.substeps, softer materials or slower motions help; time.max_halvings allows more halving"
          : "raise time.substeps, soften the materials, or take time.integrator = \"implicit-euler\", which has no "
            "stability limit";
  throw assets::UserError(
      assets::ErrorKind::kSimulation, scene.file.string(),
      fmt::format("the simulation failed on the way to frame {} (t = {:.4g} s): {}{}{}. Frames 1 to {} are kept; {}",
                  frame, (frame - 1) / scene.time.fps, what, report.reason,
                  implicit ? fmt::format(", also with the step halved {} times", scene.time.max_halvings) : "",
                  frame - 1, what_to_do));
}

/// Bodies and fields of a scene; what it does not have is not built.
class World {
 public:
  World(const assets::Scene& scene, const Shapes& shapes) : scene_(scene), fields_(build_fields(scene, shapes)) {
    if (!scene.soft.empty() || !scene.cloth.empty() || !scene.springs.empty())
      bodies_ = std::make_unique<sim::Simulation>(build_model(scene, shapes), simulation_settings(scene));
  }

  int vertices() const { return bodies_ ? bodies_->model().vertices() : 0; }

  /// Goes on by h on the way to `frame`. Throws UserError (kSimulation).
  void step(double h, int frame, sim::StepReport& sum) {
    t_ += h;
    if (bodies_) {
      sum.add(bodies_->step(h));
      if (!sum.converged) give_up(scene_, frame, "", sum, bodies_->implicit());
    }
    for (size_t i = 0; i < fields_.size(); ++i) {
      sim::StepReport report = fields_[i].step(h);
      if (!report.converged) give_up(scene_, frame, fmt::format("field '{}': ", scene_.fields[i].name), report, false);
      if (bodies_) report.steps = 0;  // steps of the scene are counted once
      if (i > 0) report.steps = 0;
      sum.add(report);
    }
  }

  CachedFrame frame(const sim::StepReport& sum) const {
    CachedFrame frame;
    if (bodies_) {
      frame.state = bodies_->state();
      frame.memory = bodies_->memory();
      frame.figures.energies = bodies_->energies();
    } else {
      frame.state.t = t_;
    }
    frame.figures.steps = static_cast<double>(sum.steps);
    frame.figures.newton_iterations = static_cast<double>(sum.newton_iterations);
    frame.figures.linear_iterations = static_cast<double>(sum.linear_iterations);
    frame.figures.retried_steps = static_cast<double>(sum.retries);
    for (const sim::Field& field : fields_) frame.fields.push_back({field.value(), field.rate(), field.memory()});
    return frame;
  }

  void restore(const CachedFrame& frame) {
    t_ = frame.state.t;
    if (bodies_) bodies_->restore(frame.state, frame.memory);
    for (size_t i = 0; i < fields_.size(); ++i)
      fields_[i].restore(t_, frame.fields[i].value, frame.fields[i].rate, frame.fields[i].memory);
  }

 private:
  const assets::Scene& scene_;
  double t_ = 0;
  std::unique_ptr<sim::Simulation> bodies_;
  std::vector<sim::Field> fields_;
};

}  // namespace

ClipRun simulate_clip(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache, int last, bool quiet) {
  const auto start = std::chrono::steady_clock::now();
  ClipRun run;
  World world(scene, shapes);
  run.vertices = world.vertices();

  int frame = 0;
  std::optional<CachedFrame> from;
  while (frame < last) {
    std::optional<CachedFrame> next = cache.read(frame + 1, run.vertices);
    if (!next || next->fields.size() != scene.fields.size()) break;
    from = std::move(next);
    ++frame;
  }
  run.frames_from_cache = frame;
  if (from && frame < last) {
    world.restore(*from);
    say(quiet, fmt::format("frames 1 to {} are simulated already; going on from there", frame));
  }
  if (frame == 0) {
    cache.write(1, world.frame({}));
    frame = 1;
    run.frames_simulated = 1;
  }
  {
    Progress progress("simulate", last - frame, quiet);
    for (++frame; frame <= last; ++frame) {
      sim::StepReport sum;
      for (int step = 0; step < scene.time.substeps; ++step) {
        stop_if_interrupted();
        world.step(scene.time.step(), frame, sum);
      }
      cache.write(frame, world.frame(sum));
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
