#include "app/forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/forecast_text.h"
#include "assets/error.h"
#include "assets/scene_limits.h"
#include "sim/simulation.h"
#include "sim/stability.h"
#include "sim/step_limit.h"

namespace softreel::app {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool fixed_point(const assets::Scene& scene) {
  return sim::is_implicit(scene.time.integrator) && scene.solver.method == "fixed-point";
}

double clip_seconds(const assets::Scene& scene) { return (scene.time.frames() - 1) / scene.time.fps; }

double growth_of(const assets::Scene& scene, const sim::Oscillation& mode, double h) {
  if (!fixed_point(scene)) return sim::log_growth(scene.time.integrator, mode, h, clip_seconds(scene));
  return std::log(sim::fixed_point_rate(scene.time.integrator, h * mode.omega, mode.damping_ratio));
}

double limit_of(const assets::Scene& scene, const sim::Oscillation& mode) {
  return fixed_point(scene) ? sim::largest_fixed_point_step(scene.time.integrator, mode)
                            : sim::largest_step(scene.time.integrator, mode, clip_seconds(scene));
}

/// The worst of the modes at a step of h. The growth is that of the frequency found, which is never too high; the
/// largest step that of its bound: so neither says too much.
StepForecast step_forecast(const assets::Scene& scene, const sim::Model& model, const std::vector<sim::Mode>& modes,
                           double h) {
  StepForecast worst;
  worst.largest_step = kInfinity;
  worst.log_growth = -kInfinity;
  for (size_t m = 0; m < modes.size(); ++m) {
    const sim::Mode& mode = modes[m];
    const double growth = growth_of(scene, {mode.omega, mode.damping_ratio}, h);
    const double limit = limit_of(scene, {mode.omega_bound, mode.damping_ratio});
    if (m == 0 || limit < worst.largest_step) {
      worst.omega = worst.omega_at_limit = mode.omega;
      worst.damping_ratio = mode.damping_ratio;
      worst.place = sim::place_of(model, mode);
    }
    worst.largest_step = std::min(worst.largest_step, limit);
    worst.log_growth = std::max(worst.log_growth, growth);
  }
  return worst;
}

/// Penalties and the worst damped mode change with the step: the step that equals the limit which it sets itself. 0 if
/// there is none: a penalty that stiffens as the step shrinks leaves some methods no step at all.
void settle(const assets::Scene& scene, const sim::Model& model, sim::Linearization& linear, sim::Touch touch, double h,
            StepForecast& f) {
  constexpr int kMostRounds = 24;
  constexpr double kClose = 5e-3, kVanishing = 1e-6;
  double step = h, limit = f.largest_step;
  for (int round = 0; round < kMostRounds && std::isfinite(limit) && std::abs(limit / step - 1) > kClose; ++round) {
    if (limit < kVanishing * h) break;
    step = limit;
    linear.set_step(step);
    const StepForecast next = step_forecast(scene, model, linear.fastest(touch), step);
    limit = next.largest_step;
    f.omega_at_limit = next.omega;
  }
  linear.set_step(h);
  if (std::isfinite(limit)) limit = std::abs(limit / step - 1) > kClose ? 0 : std::min(step, limit);
  f.largest_step = limit;
}

Verdict verdict_of(const assets::Scene& scene, const Forecast& f) {
  if (!f.limited) return Verdict::kHolds;
  const double most = fixed_point(scene) ? 0 : std::log(sim::kMostGrowth);
  // What grows by more than this grows out of the last bit of what is there.
  const double hopeless = fixed_point(scene) ? std::log(std::pow(4.0, scene.time.max_halvings))
                                             : -std::log(std::numeric_limits<double>::epsilon());
  if (f.apart.log_growth > hopeless) return Verdict::kHopeless;
  if (f.apart.log_growth > most) return Verdict::kUnstable;
  if (f.touching && f.touching->log_growth > most) return Verdict::kHoldsApart;
  return Verdict::kHolds;
}

int substeps_for(const assets::Scene& scene, double step) {
  const double substeps = std::ceil(1 / (scene.time.fps * step * (1 - kSpare)));
  const bool allowed = substeps <= assets::kSubsteps.hi && substeps * scene.time.frames() <= assets::kMostSteps;
  return allowed ? static_cast<int>(substeps) : 0;
}

}  // namespace

bool has_step_limit(const assets::Scene& scene) {
  return !sim::is_implicit(scene.time.integrator) || (fixed_point(scene) && scene.time.integrator != "static");
}

namespace {

Forecast forecast_with(sim::Linearization& linear, const assets::Scene& scene, const sim::Model& model) {
  Forecast f;
  f.limited = has_step_limit(scene);
  f.h = scene.time.step();
  const std::vector<sim::Mode> free = linear.fastest(sim::Touch::kNone);
  f.apart = step_forecast(scene, model, free, f.h);
  if (!f.limited) return f;
  if (linear.has_contact()) f.touching = step_forecast(scene, model, linear.fastest(sim::Touch::kAll), f.h);
  f.verdict = verdict_of(scene, f);
  if (free.size() > 1) settle(scene, model, linear, sim::Touch::kNone, f.h, f.apart);
  if (f.touching) settle(scene, model, linear, sim::Touch::kAll, f.h, *f.touching);
  if (std::isfinite(f.largest_step())) f.substeps = substeps_for(scene, f.largest_step());
  return f;
}

}  // namespace

Forecast forecast_step(const assets::Scene& scene, const sim::Model& model) {
  sim::Linearization linear(model, scene.time.step());
  return forecast_with(linear, scene, model);
}

Forecast make_forecast(const assets::Scene& scene, const sim::Model& model) {
  sim::Linearization linear(model, scene.time.step());
  Forecast f = forecast_with(linear, scene, model);
  const double omega = linear.fastest(sim::Touch::kNone)[0].omega;
  if (model.bodies.size() > 1)
    for (const sim::BodyRange& body : model.bodies)
      f.omega_of_body.push_back(linear.fastest(sim::Touch::kNone, &body)[0].omega);
  sim::Linearization stretched(model, f.h, kStretch);
  if (omega > 0) f.stretched = stretched.fastest(sim::Touch::kNone)[0].omega / omega;
  return f;
}

void refuse_hopeless(const assets::Scene& scene, const sim::Model& model) {
  if (!has_step_limit(scene) || model.vertices() == 0) return;
  Forecast f;
  f.limited = true;
  f.h = scene.time.step();
  f.apart = step_forecast(scene, model, sim::Linearization(model, f.h).fastest(sim::Touch::kNone), f.h);
  if (verdict_of(scene, f) != Verdict::kHopeless) return;
  throw assets::UserError(assets::ErrorKind::kUsage, scene.file.string(),
                          verdict_sentence(scene, make_forecast(scene, model)) + ". --force simulates it all the same");
}

}  // namespace softreel::app
