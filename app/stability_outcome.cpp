#include "app/stability_outcome.h"

#include <algorithm>
#include <cmath>

#include "sim/simulation.h"

namespace softreel::app {
namespace {

constexpr double kSmall = 0.1, kMost = 0.5;  // of the energy in motion
// A driven scene blew up where this many times its largest energy in a clip's first tenth appears later: driving, too,
// is steady or slower than that, a blow-up is a power law of the steps.
constexpr double kDrivenBlowUp = 1e6;

double in_motion(const sim::Energies& e) { return e.kinetic + e.elastic + e.contact; }
double total(const sim::Energies& e) { return in_motion(e) + e.gravity + e.dissipated; }

bool blew_up_driven(const Trial& trial) {
  double early = 0, most = 0;
  for (size_t f = 0; f < trial.frames.size(); ++f) {
    const double energy = in_motion(trial.frames[f].figures.energies);
    if (f <= 1 + trial.frames.size() / 10) early = std::max(early, energy);
    most = std::max(most, energy);
  }
  return !std::isfinite(most) || (early > 0 && most > kDrivenBlowUp * early);
}

}  // namespace

std::string_view outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kHeld:
      return "held";
    case Outcome::kDampedAway:
      return "damped away";
    case Outcome::kDrifted:
      return "drifted";
    case Outcome::kBlewUp:
      return "blew up";
    case Outcome::kNotConverged:
      return "did not converge";
    case Outcome::kRefused:
      return "refused";
    case Outcome::kNotRun:
      return "not run";
  }
  return "";
}

double energy_change(const Trial& trial) {
  double most = 0, gain = 0, last = 0, size = 0;
  const double start = trial.frames.empty() ? 0 : total(trial.frames.front().figures.energies);
  for (const CachedFrame& frame : trial.frames) {
    const sim::Energies& e = frame.figures.energies;
    last = total(e) - start;
    gain = std::max(gain, last);
    most = std::max(most, in_motion(e));
    size = std::max(size, std::abs(e.gravity));
  }
  if (!std::isfinite(gain) || !std::isfinite(most)) return std::numeric_limits<double>::infinity();
  // Below the rounding of the sums nothing can be told.
  if (most <= 1e-12 * size || most == 0) return 0;
  return (gain > -last ? gain : last) / most;
}

bool is_driven(const assets::Scene& scene) {
  const auto moves = [](const auto& things) {
    return std::any_of(things.begin(), things.end(), [](const auto& thing) {
      return std::any_of(thing.pins.begin(), thing.pins.end(),
                         [](const assets::Pin& pin) { return !pin.motion.empty(); });
    });
  };
  return moves(scene.soft) || moves(scene.cloth) || moves(scene.springs) || scene.wind.has_value() ||
         std::any_of(scene.colliders.begin(), scene.colliders.end(),
                     [](const assets::Collider& c) { return !c.motion.empty(); }) ||
         std::any_of(scene.loads.begin(), scene.loads.end(),
                     [](const assets::Load& l) { return l.from > 0 || l.until || l.ramp > 0; });
}

Outcome outcome_of(const assets::Scene& scene, const Trial& trial) {
  if (trial.failure) switch (trial.failure->end) {
      case TrialEnd::kRefused:
        return Outcome::kRefused;
      case TrialEnd::kBudget:
      case TrialEnd::kStopped:
        return Outcome::kNotRun;
      case TrialEnd::kFailed:
        return sim::is_implicit(scene.time.integrator) ? Outcome::kNotConverged : Outcome::kBlewUp;
    }
  if (is_driven(scene)) return blew_up_driven(trial) ? Outcome::kBlewUp : Outcome::kHeld;
  const double change = energy_change(trial);
  if (change > kMost) return Outcome::kBlewUp;
  if (change < -kMost) return Outcome::kDampedAway;
  return std::abs(change) > kSmall ? Outcome::kDrifted : Outcome::kHeld;
}

}  // namespace softreel::app
