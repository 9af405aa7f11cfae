#pragma once
// What became of a trial, judged by its energies.
#include <array>
#include <string_view>

#include "app/trial.h"

namespace softreel::app {

enum class Outcome {
  kHeld,          ///< energy is what it was at the start, but for kSmall
  kDampedAway,    ///< more than half of the motion's energy is lost to the method
  kDrifted,       ///< in between, up or down
  kBlewUp,        ///< more than half of the energy came from nowhere, or positions ran away
  kNotConverged,  ///< a solve did not get to its end
  kRefused,       ///< the scene cannot be built so
  kNotRun,        ///< no time was left
};

/// What a run can come to: all but kRefused and kNotRun.
inline constexpr std::array kMeasured = {Outcome::kHeld, Outcome::kDampedAway, Outcome::kDrifted, Outcome::kBlewUp,
                                         Outcome::kNotConverged};

/// "held", "damped away", "drifted", "blew up", "did not converge", "refused", "not run".
std::string_view outcome_name(Outcome outcome);

/// The share of the energy in motion that a trial has gained (> 0) or lost (< 0) without a force that does work:
/// (E(t) - E(0))/max (kinetic + elastic + contact), E with gravity, dead loads and all that dissipation potentials
/// took. Gains count at their largest, losses at the end. 0 for what never moves. What pins, colliders, wind and
/// changing loads put in counts as a gain: of driven scenes only a blow-up can be told.
double energy_change(const Trial& trial);

/// Whether something in the scene does work from outside, so that energy need not be kept.
bool is_driven(const assets::Scene& scene);

Outcome outcome_of(const assets::Scene& scene, const Trial& trial);

}  // namespace softreel::app
