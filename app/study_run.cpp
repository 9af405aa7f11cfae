#include "app/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/hashes.h"
#include "app/progress.h"
#include "assets/content_hash.h"
#include "assets/error.h"
#include "sim/catalogue.h"
#include "sim/parallel.h"

namespace softreel::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kVersion = 1;          // raised when rows come out different
constexpr double kLost = 10;         // sizes of the scene: farther from where it belongs, a run is given up
constexpr double kMeasured = 0.1;    // [s] of repeats, below which a clock and other work make a median jump
constexpr double kRepeatPart = 100;  // a run is repeated if it takes at most this part of the budget left

double seconds_until(Clock::time_point end) { return std::chrono::duration<double>(end - Clock::now()).count(); }

long steps_of(const assets::Scene& s) { return static_cast<long>(s.time.frames() - 1) * s.time.substeps; }

/// Gradients that a step is worth, before anything has been measured: an implicit step assembles and solves some
/// Newton iterations, more for a tighter tolerance.
double weight_of(const assets::Scene& s) {
  if (s.time.integrator == "rk4") return 4;
  if (!sim::is_implicit(s.time.integrator)) return 1.5;
  return 15 * (1 - std::log10(s.solver.tolerance) / 3);
}

StudyRow empty_row(const StudyVariant& v) {
  StudyRow row;
  row.method = v.method;
  row.label = v.label;
  row.integrator = v.scene.time.integrator;
  row.settings = v.settings;
  row.present = v.present;
  row.step = v.scene.time.step();
  return row;
}

/// Threads count in times, not in states; the reference in errors, the camera in pixels.
std::string hash_of(const StudyPlan& plan, const StudyVariant& v) {
  assets::ContentHasher hasher;
  hasher.add(kVersion).add(simulation_hash(v.scene)).add(v.scene.time.frames()).add(plan.reference.hash);
  hasher.add(plan.repeats).add(sim::threads()).add(frame_hash(plan.sweep.scene, ""));
  return hasher.hex();
}

void take_figures(const Trial& trial, StudyRow& row) {
  row.wall = trial.wall_seconds;
  row.processor = trial.processor_seconds;
  row.setup = trial.setup_seconds;
  row.stages = trial.total.seconds;
  row.steps = trial.total.steps;
  row.newton = trial.total.newton_iterations;
  row.linear = trial.total.linear_iterations;
  row.retries = trial.total.retries;
  row.peak_memory = trial.peak_memory_bytes;
  row.energy = energy_changes(trial);
  row.vertices = trial.frames.empty() ? 0 : static_cast<long>(trial.frames.front().state.x.size()) / 3;
}

/// Times of the repeat whose wall time is the median.
void take_median(std::vector<Trial>& trials, StudyRow& row) {
  const auto middle = trials.begin() + static_cast<std::ptrdiff_t>((trials.size() - 1) / 2);
  std::nth_element(trials.begin(), middle, trials.end(),
                   [](const Trial& a, const Trial& b) { return a.wall_seconds < b.wall_seconds; });
  take_figures(*middle, row);
  row.repeats = static_cast<int>(trials.size());
}

void run_variant(const StudyPlan& plan, const StudyVariant& v, SharedShapes& shared, const std::string& hash,
                 StudyRow& row) {
  row.run = true;
  if (!v.refusal.empty()) {
    row.failure = TrialFailure{TrialEnd::kRefused, 1, 0, 0, v.refusal};
    return plan.store.write(hash, row, nullptr);
  }
  const Shapes& shapes = shared.of(v.scene);
  const PointMap map(plan.points, shapes);
  TrialOptions options;
  options.seconds = seconds_until(plan.end);
  options.stop = [&](const ClipWorld& world, int frame) {
    const auto& expected = plan.reference.points[static_cast<size_t>(frame) - 1];
    const double off = (map.at(world.bodies()->state().x) - expected).colwise().norm().maxCoeff();
    return off < kLost * plan.reference.size ? std::string() : fmt::format("{:.3g} m from where it belongs", off);
  };
  std::vector<Trial> trials;
  trials.push_back(run_trial(v.scene, shapes, options));
  if (trials[0].failure) {
    row.failure = trials[0].failure;
    take_figures(trials[0], row);
    row.repeats = 1;
    if (row.failure->end != TrialEnd::kBudget) plan.store.write(hash, row, nullptr);
    return;
  }
  std::vector<Eigen::Matrix3Xd> at;
  for (const CachedFrame& frame : trials[0].frames) at.push_back(map.at(frame.state.x));
  row.errors = position_errors(at, plan.reference.points, &plan.view);
  row.drifts = drifts(v.scene, shapes, trials[0], plan.reference.size);
  const CachedFrame last = trials[0].frames.back();
  double measured = trials[0].wall_seconds;
  while ((static_cast<int>(trials.size()) < plan.repeats || (plan.repeats > 1 && measured < kMeasured)) &&
         trials.back().wall_seconds * kRepeatPart < seconds_until(plan.end)) {
    Trial again = run_trial(v.scene, shapes, options);
    if (again.failure) break;  // the budget is over
    measured += again.wall_seconds;
    trials.push_back(std::move(again));
  }
  take_median(trials, row);
  plan.store.write(hash, row, &last);
}

}  // namespace

double expected_seconds(const std::vector<StudyVariant>& variants, const std::vector<StudyRow>& rows, size_t which) {
  // Of the same method the seconds per step, those of the nearest number of steps; else of all what a weight took.
  const assets::Scene& scene = variants[which].scene;
  const double steps = static_cast<double>(steps_of(scene));
  double nearest = std::numeric_limits<double>::infinity(), per_step = 0, seconds = 0, weights = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].done()) continue;
    const double n = static_cast<double>(steps_of(variants[i].scene));
    seconds += rows[i].wall;
    weights += n * weight_of(variants[i].scene);
    const double ratio = std::abs(std::log(n / steps));
    if (rows[i].method != rows[which].method || !(ratio < nearest)) continue;
    nearest = ratio;
    per_step = rows[i].wall / n;
  }
  if (per_step > 0) return per_step * steps;
  return steps * weight_of(scene) * (weights > 0 ? seconds / weights : 0);
}

std::vector<StudyRow> run_variants(const StudyPlan& plan, SharedShapes& shapes, std::vector<std::string>& hashes) {
  const std::vector<StudyVariant>& variants = plan.sweep.variants;
  std::vector<StudyRow> rows;
  std::vector<size_t> left;
  Progress progress("study", static_cast<int>(variants.size()), plan.quiet, "runs");
  for (size_t i = 0; i < variants.size(); ++i) {
    rows.push_back(empty_row(variants[i]));
    hashes.push_back(hash_of(plan, variants[i]));
    if (plan.store.read(hashes[i], rows[i]))
      progress.advance();
    else
      left.push_back(i);
  }
  const auto before = [&](size_t a, size_t b) {
    const double x = expected_seconds(variants, rows, a), y = expected_seconds(variants, rows, b);
    if (x != y) return x < y;
    const auto prior = [&](size_t i) {
      return static_cast<double>(steps_of(variants[i].scene)) * weight_of(variants[i].scene);
    };
    return prior(a) < prior(b);
  };
  while (!left.empty()) {
    const auto next = std::min_element(left.begin(), left.end(), before);
    const double time = seconds_until(plan.end);
    if (time <= 0 || expected_seconds(variants, rows, *next) > time) break;  // all others take longer
    run_variant(plan, variants[*next], shapes, hashes[*next], rows[*next]);
    left.erase(next);
    progress.advance();
  }
  for (const size_t i : left)
    rows[i].failure = TrialFailure{
        TrialEnd::kBudget, 1, 0, 0,
        fmt::format("not run: about {:.3g} s would have been needed", expected_seconds(variants, rows, i))};
  return rows;
}

}  // namespace softreel::app
