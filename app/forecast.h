#pragma once
// What can be said of a scene's stability before it is run: from its fastest motion about the start and the
// integrator's own one-step matrix.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "assets/scene.h"
#include "sim/linearization.h"
#include "sim/model.h"

namespace softreel::app {

enum class Verdict {
  kHolds,       ///< no motion more than doubles over the clip by the method's fault, in contact too
  kHoldsApart,  ///< that, but only as long as nothing touches a collider
  kUnstable,    ///< some motion grows
  kHopeless,    ///< so fast that even rounding errors outgrow the scene before the clip ends
};

/// How a step of the scene does, for bodies that touch nothing, or all of whose vertices touch (sim::Touch).
struct StepForecast {
  double omega = 0;           ///< of the mode that limits the step [rad/s]
  double damping_ratio = 0;   ///< of that mode [-]
  double log_growth = 0;      ///< ln of its growth over the clip; <= 0: none. Of `fixed-point`: per iteration
  double largest_step = 0;    ///< [s]; infinity: no limit; 0: none holds, however short
  double omega_at_limit = 0;  ///< of the mode that limits that step: penalties change with it [rad/s]
  sim::ModePlace place;       ///< where it moves most
};

struct Forecast {
  bool limited = false;                  ///< explicit, or `fixed-point`: there is a largest step
  double h = 0;                          ///< [s]
  StepForecast apart;                    ///< bodies that touch nothing
  std::optional<StepForecast> touching;  ///< where there are colliders
  Verdict verdict = Verdict::kHolds;
  int substeps = 0;      ///< that hold, with kSpare to spare; 0: none that the scene file takes. If limited
  double stretched = 1;  ///< omega where all is stretched by kStretch, over omega at the start
  std::vector<double> omega_of_body;  ///< as model.bodies, others held [rad/s]; for more than one body

  /// What holds whatever touches [s]; where no step does, what holds apart.
  double largest_step() const {
    return touching && touching->largest_step > 0 ? std::min(apart.largest_step, touching->largest_step)
                                                  : apart.largest_step;
  }
};

/// Part of a step that a recommended setting leaves unused: omega grows with deformation.
inline constexpr double kSpare = 0.1;
inline constexpr double kStretch = 1.2;

/// Whether the scene's integrator and solver have a largest step at all. If not, there is nothing to fear and nothing
/// to compute.
bool has_step_limit(const assets::Scene& scene);

/// Frequency, growth and limit of the step alone, without what `check` prints beside them. For a scene with a limit.
Forecast forecast_step(const assets::Scene& scene, const sim::Model& model);

/// Everything, for `check`. `model`: of build_model; its terms begin a step. Not for time.integrator = "static".
Forecast make_forecast(const assets::Scene& scene, const sim::Model& model);

/// Throws UserError (kUsage) if the setting is hopeless. Costs about as much as some steps, and nothing without a
/// limit.
void refuse_hopeless(const assets::Scene& scene, const sim::Model& model);

}  // namespace softreel::app
