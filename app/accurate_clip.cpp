#include "app/accurate_clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "app/accuracy.h"
#include "app/clip_world.h"
#include "app/field_world.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/world.h"
#include "assets/error.h"
#include "sim/adaptive_plan.h"
#include "sim/linearization.h"
#include "sim/step_limit.h"

namespace softreel::app {
namespace {

using sim::AdaptivePlan;
using sim::AdaptiveRun;

int order_of(const std::string& integrator) {
  for (const sim::MethodInfo& method : sim::integrators())
    if (method.name == integrator) return method.order;
  return 1;
}

/// Steps of an interval between frames below which an explicit method is unstable, or fewer than the scene asks for.
double least_steps(const assets::Scene& scene, const Shapes& shapes) {
  const assets::Time& time = scene.time;
  double least = time.substeps > 1 ? time.substeps : 0;
  if (sim::is_implicit(time.integrator)) return least;
  const ClipWorld world(scene, shapes);
  if (!scene.fields.empty()) least = std::max(least, field_steps_per_frame(scene, world.fields()));
  if (!world.bodies()) return least;
  const sim::Model model = build_model(scene, shapes);
  sim::Linearization linear(model, 1 / time.fps);
  for (const sim::Mode& mode : linear.fastest(sim::Touch::kNone)) {
    const double h = sim::largest_step(time.integrator, {mode.omega_bound, mode.damping_ratio}, time.duration);
    if (h > 0) least = std::max(least, 1 / (time.fps * h));
  }
  return least;
}

/// One run that held: its frames from 1 on are those of the clip that it visits.
struct DoneRun {
  ClipCache cache;
  std::vector<int> visited;

  CachedFrame read(int frame) const {
    const auto at = std::lower_bound(visited.begin(), visited.end(), frame);
    std::optional<CachedFrame> data = cache.read(static_cast<int>(at - visited.begin()) + 1);
    if (!data)
      throw assets::UserError(assets::ErrorKind::kInput, cache.folder().string(),
                              fmt::format("the cached state of frame {} went missing", frame + 1));
    return std::move(*data);
  }
  bool visits(int frame) const { return std::binary_search(visited.begin(), visited.end(), frame); }
};

class Search {
 public:
  Search(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache, bool quiet)
      : scene_(scene),
        shapes_(shapes),
        cache_(cache),
        quiet_(quiet),
        order_(order_of(scene.time.integrator)),
        plan_({scene.time.frames() - 1, order_, least_steps(scene, shapes), scene.solver.tolerance}) {}

  ClipRun run() {
    while (plan_.verdict() == AdaptivePlan::Verdict::kGoOn) {
      const ClipCache cache = cache_.beside(fmt::format("run_{}", ++runs_));
      const std::vector<int> visited = sim::visited_frames(scene_.time.frames() - 1, plan_.run().stride);
      if (const std::optional<StepFailure> failure = simulate(plan_.run(), cache, visited)) {
        why_ = failure->why;
        plan_.failed();
        continue;
      }
      done_.push_back({cache, visited});
      plan_.held(figures());
    }
    if (done_.empty() || done_.back().visited.size() < static_cast<size_t>(scene_.time.frames())) give_up();
    deliver();
    return result_;
  }

 private:
  std::optional<StepFailure> simulate(const AdaptiveRun& run, const ClipCache& cache, const std::vector<int>& visited) {
    assets::Scene scene = scene_;
    scene.solver.tolerance = run.tolerance;
    ClipWorld world(scene, shapes_);
    result_.vertices = world.vertices();
    size_t frame = 0;
    std::optional<CachedFrame> from;
    while (frame < visited.size()) {
      std::optional<CachedFrame> next = cache.read(static_cast<int>(frame) + 1, result_.vertices);
      if (!next || next->fields.size() != scene.fields.size()) break;
      coarse_steps_ += next->figures.steps;
      from = std::move(next);
      ++frame;
    }
    if (from) world.restore(*from);
    if (frame == 0) cache.write(static_cast<int>(++frame), world.frame({}));
    Progress progress(fmt::format("accuracy, run {} of {} steps:", runs_, run.total()),
                      static_cast<int>(visited.size() - frame), quiet_);
    for (; frame < visited.size(); ++frame) {
      const int steps = run.steps[frame - 1];
      const double h = (visited[frame] - visited[frame - 1]) / (scene.time.fps * steps);
      sim::StepReport sum;
      for (int step = 0; step < steps; ++step) {
        stop_if_interrupted();
        if (auto failure = world.step(h, sum)) return failure;
      }
      cache.write(static_cast<int>(frame) + 1, world.frame(sum));
      coarse_steps_ += static_cast<double>(sum.steps);
      result_.total.add(sum);
      progress.advance();
    }
    return std::nullopt;
  }

  /// Of the last run, compared with the two before it: the plan looks at no others.
  sim::AdaptiveFigures figures() {
    const DoneRun& last = done_.back();
    FieldSpans spans;
    for (int f : last.visited) {
      const CachedFrame frame = last.read(f);
      if (f == 0 && target_.length == 0 && target_.of_range == 0) target_ = accuracy_target(scene_, shapes_, frame);
      if (!frame.fields.empty()) spans.add(frame);
    }
    sim::AdaptiveRecorder recorder(order_, done_.size() - 1);
    for (int f : last.visited) {
      std::vector<Eigen::VectorXd> solutions;
      std::vector<const Eigen::VectorXd*> earlier(done_.size() - 1, nullptr);
      solutions.reserve(2);
      for (size_t i = done_.size() < 3 ? 0 : done_.size() - 3; i + 1 < done_.size(); ++i) {
        if (!done_[i].visits(f)) continue;
        solutions.push_back(scaled_solution(done_[i].read(f), target_, spans));
        earlier[i] = &solutions.back();
      }
      recorder.add(scaled_solution(last.read(f), target_, spans), earlier);
    }
    return recorder.figures();
  }

  [[noreturn]] void give_up() const {
    throw assets::UserError(
        assets::ErrorKind::kSimulation, scene_.file.string(),
        fmt::format("the simulation failed in each of {} runs, the last one with {} steps: {}. Softer materials or "
                    "slower motions help; without time.accuracy, time.substeps sets the steps",
                    runs_, plan_.run().total(), why_));
  }

  void deliver() {
    const DoneRun& last = done_.back();
    const std::vector<double> estimates = plan_.estimate_of_frames();
    double own_steps = 0;
    for (int f : last.visited) own_steps += last.read(f).figures.steps;
    for (int f : last.visited) {
      CachedFrame frame = last.read(f);
      frame.figures.accuracy = {estimates[static_cast<size_t>(f)] * scene_.time.accuracy->value,
                                f == 0 ? coarse_steps_ - own_steps : 0, plan_.verdict() == AdaptivePlan::Verdict::kMet};
      cache_.write(f + 1, frame);
    }
    result_.frames_simulated = scene_.time.frames();
    for (int run = 1; run <= runs_; ++run) cache_.beside(fmt::format("run_{}", run)).remove();
  }

  const assets::Scene& scene_;
  const Shapes& shapes_;
  const ClipCache& cache_;
  bool quiet_;
  int order_;
  AdaptivePlan plan_;
  AccuracyTarget target_;
  std::vector<DoneRun> done_;
  ClipRun result_;
  int runs_ = 0;
  double coarse_steps_ = 0;  // of all runs, what was cached included
  std::string why_;          // the last run that failed did so
};

}  // namespace

std::string accurate_steps_text(const assets::Scene& scene, const Shapes& shapes) {
  const double least = least_steps(scene, shapes);
  const std::string from =
      least > 0 ? fmt::format("not below {} a frame{}", static_cast<long>(std::ceil(least)),
                              sim::is_implicit(scene.time.integrator)
                                  ? ", as time.substeps asks"
                                  : fmt::format(", where {} holds without contact at the start", scene.time.integrator))
                : fmt::format("{} holds at any step", scene.time.integrator);
  return fmt::format(
      "stability: the steps are found in the run, {}; a run that fails is taken anew with finer ones, and of those "
      "that "
      "hold the error is estimated",
      from);
}

ClipRun simulate_to_accuracy(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache, bool quiet) {
  if (scene.time.frames() < 2) return simulate_clip(scene, shapes, cache, 1, quiet);
  const auto start = std::chrono::steady_clock::now();
  ClipRun run = Search(scene, shapes, cache, quiet).run();
  run.solver = run.total.solver;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace softreel::app
