// What is promised about the error of a clip, on scenes without impacts: small enough, not much smaller, and for how
// much more work than with the best number of equal steps, which nobody knows beforehand.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/adaptive_plan.h"
#include "sim/linearization.h"
#include "sim/step_limit.h"
#include "tests/sim/adaptive_scenes.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

using Frames = std::vector<Eigen::VectorXd>;  // scaled: 1 is the target

struct Run {
  bool held = true;
  Frames frames;
  long steps = 0, work = 0;
};

Run run_clip(const AdaptiveScene& scene, const std::string& integrator, const AdaptiveRun& plan) {
  SimulationSettings settings;
  settings.integrator = integrator;
  settings.minimizer.tolerance = plan.tolerance;
  Simulation s(scene.make(), settings);
  const double scale = 1 / (scene.target * std::sqrt(double(s.model().vertices())));
  const std::vector<int> visited = visited_frames(scene.intervals, plan.stride);
  Run run;
  run.frames.push_back(scale * s.state().x);
  StepReport sum;
  for (size_t way = 0; way < plan.steps.size(); ++way) {
    const int n = plan.steps[way];
    for (int i = 0; i < n; ++i) {
      sum.add(s.step((visited[way + 1] - visited[way]) / (scene.fps * n)));
      if (!sum.converged) {
        run.held = false;
        run.work = s.implicit() ? sum.newton_iterations : sum.steps;
        return run;
      }
    }
    run.frames.push_back(scale * s.state().x);
  }
  run.steps = sum.steps;
  run.work = s.implicit() ? sum.newton_iterations : sum.steps;
  return run;
}

double apart(const Frames& a, const Frames& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const size_t stride = (b.size() - 1 + a.size() - 2) / (a.size() - 1);
    largest = std::max(largest, (a[i] - b[std::min(i * stride, b.size() - 1)]).norm());
  }
  return std::isfinite(largest) ? largest : HUGE_VAL;
}

int order_of(const std::string& integrator) {
  for (const MethodInfo& m : integrators())
    if (m.name == integrator) return m.order;
  return 0;
}

AdaptiveRun equal(const AdaptiveScene& scene, int n, double tolerance) {
  return {1, std::vector<int>(size_t(scene.intervals), n), tolerance};
}

double least_steps(const AdaptiveScene& scene, const std::string& integrator) {
  if (is_implicit(integrator)) return 0;
  const Model model = scene.make();
  Linearization linear(model, 1 / scene.fps);
  double h = HUGE_VAL;
  for (const Mode& m : linear.fastest(Touch::kNone))
    h = std::min(h, largest_step(integrator, {m.omega_bound, m.damping_ratio}, scene.intervals / scene.fps));
  return 1 / (scene.fps * h);
}

struct Outcome {
  AdaptivePlan::Verdict verdict;
  double estimate, achieved;
  long steps, work;
  double tolerance;
  int runs;
};

Outcome adapt(const AdaptiveScene& scene, const std::string& integrator, const Frames& reference) {
  const int p = order_of(integrator);
  AdaptivePlan plan({scene.intervals, p, least_steps(scene, integrator), 1e-3});
  std::vector<Frames> earlier;
  std::vector<int> strides;
  Outcome o{};
  while (plan.verdict() == AdaptivePlan::Verdict::kGoOn) {
    const AdaptiveRun asked = plan.run();
    const Run run = run_clip(scene, integrator, asked);
    o.work += run.work;
    ++o.runs;
    if (!run.held) {
      plan.failed();
      continue;
    }
    AdaptiveRecorder recorder(p, earlier.size());
    const std::vector<int> visited = visited_frames(scene.intervals, asked.stride);
    for (size_t f = 0; f < run.frames.size(); ++f) {
      std::vector<const Eigen::VectorXd*> others;
      for (size_t e = 0; e < earlier.size(); ++e) {
        const std::vector<int> theirs = visited_frames(scene.intervals, strides[e]);
        const auto at = std::find(theirs.begin(), theirs.end(), visited[f]);
        others.push_back(at == theirs.end() ? nullptr : &earlier[e][size_t(at - theirs.begin())]);
      }
      recorder.add(run.frames[f], others);
    }
    plan.held(recorder.figures());
    strides.push_back(asked.stride);
    earlier.push_back(run.frames);
    o.steps = run.steps;
    o.tolerance = asked.tolerance;
    o.achieved = apart(run.frames, reference);
  }
  o.verdict = plan.verdict();
  o.estimate = plan.largest_estimate();
  return o;
}

/// Work of the least number of equal steps per frame that meets the target.
long work_of_best_fixed(const AdaptiveScene& scene, const std::string& integrator, double tolerance,
                        const Frames& reference) {
  long work = 0;
  const auto meets = [&](int n) {
    const Run run = run_clip(scene, integrator, equal(scene, n, tolerance));
    const bool good = run.held && apart(run.frames, reference) <= 1;
    if (good) work = run.work;
    return good;
  };
  int few = 0, enough = 1;
  for (; !meets(enough); enough *= 2) few = enough;
  while (enough - few > std::max(1, enough / 50)) (meets((few + enough) / 2) ? enough : few) = (few + enough) / 2;
  meets(enough);
  return work;
}

}  // namespace

TEST_CASE("the steps that are chosen keep the error of a clip below its target, and not far below") {
  std::printf("%-20s %-18s %8s %9s %9s %5s %6s %7s\n", "scene", "integrator", "target", "achieved", "estimate", "runs",
              "steps", "work");
  double log_factors = 0;
  int rows = 0;
  for (const AdaptiveScene& scene : adaptive_scenes()) {
    const Frames coarse = run_clip(scene, "rk4", equal(scene, 100, 0)).frames;
    const Frames reference = run_clip(scene, "rk4", equal(scene, 200, 0)).frames;
    CHECK(apart(coarse, reference) < 0.01);
    for (const std::string& integrator : scene.integrators) {
      const Outcome o = adapt(scene, integrator, reference);
      const double factor = double(o.work) / double(work_of_best_fixed(scene, integrator, o.tolerance, reference));
      std::printf("%-20s %-18s %6.2f mm %9.3f %9.3f %5d %6ld %7.2f\n", scene.name, integrator.c_str(),
                  1e3 * scene.target, o.achieved, o.estimate, o.runs, o.steps, factor);
      INFO(scene.name << ", " << integrator);
      CHECK(o.verdict == AdaptivePlan::Verdict::kMet);
      CHECK(o.estimate <= 1);
      CHECK(o.achieved <= 1);
      CHECK(o.achieved >= 0.1);
      // The last run is never the whole work, and the runs before it no more than two of its kind.
      CHECK(factor < 3.5);
      log_factors += std::log(factor);
      ++rows;
    }
  }
  std::printf("work: that of the best fixed number of steps times %.2f, in the geometric mean\n",
              std::exp(log_factors / rows));
  CHECK(std::exp(log_factors / rows) < 2.2);
}
