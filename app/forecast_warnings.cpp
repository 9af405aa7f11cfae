#include "app/forecast_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/simulation.h"

namespace softreel::app {
namespace {

void warn_of_the_method(const assets::Scene& scene, const Forecast& f, std::vector<std::string>& warnings) {
  const double h_omega = f.h * f.apart.omega;
  // A stiff pendulum gains energy a thousandfold at h omega = 10 (sim/NUMERICS.md).
  constexpr double kStiff = 10;
  const std::string& integrator = scene.time.integrator;
  if ((integrator == "newmark" || integrator == "implicit-midpoint") && h_omega >= kStiff)
    warnings.push_back(
        fmt::format("{} damps nothing, and at h omega = {:.0f} it can gain energy where stiff parts turn: the verdict "
                    "above is one for small motions. bdf2 loses what cannot be resolved, and keeps its order",
                    integrator, h_omega));
  const double longest = f.largest_step();
  if (f.limited && f.verdict == Verdict::kHolds && std::isfinite(longest) && f.stretched * f.h > longest)
    warnings.push_back(
        fmt::format("the step holds at the start, but not where bodies are stretched by {:.0f} %: they "
                    "are {:.3g} times as fast then, and {:.3g} times the step is the limit",
                    100 * (kStretch - 1), f.stretched, longest / f.h));
}

void warn_of_no_effect(const assets::Scene& scene, std::vector<std::string>& warnings) {
  if (scene.wind && scene.wind->gusts && scene.wind->velocity.isZero())
    warnings.emplace_back("wind.gusts have no effect: their amplitude is relative to wind.velocity, which is zero");
}

}  // namespace

std::vector<std::string> warnings_of(const assets::Scene& scene, const Shapes& shapes, const sim::Model& model,
                                     const Forecast* forecast) {
  std::vector<std::string> warnings;
  if (forecast) warn_of_the_method(scene, *forecast, warnings);
  warn_of_shapes(scene, shapes, warnings);
  warn_of_ratios(scene, model, warnings);
  const std::vector<MovingBody> bodies = moving_bodies(scene, shapes, model);
  const std::vector<Meeting> meetings = meetings_of(scene, bodies, model);
  warn_of_gaps(meetings, scene.contact.distance, warnings);
  if (forecast) warn_of_speeds(scene, bodies, meetings, warnings);
  warn_of_lights(scene, shapes, warnings);
  warn_of_no_effect(scene, warnings);
  return warnings;
}

}  // namespace softreel::app
