#pragma once
// How far a step may go in a clip of given length, from one mode of the scene and the method's own one-step matrix.
#include <string_view>

namespace softreel::sim {

/// u'' + 2 xi omega u' + omega^2 u = 0.
struct Oscillation {
  double omega = 0;          ///< [rad/s] >= 0
  double damping_ratio = 0;  ///< xi >= 0
};

/// Natural logarithm of the factor by which steps of h [s] multiply the mode over `duration` [s] in the long run; 0 or
/// less where it does not grow. `integrator`: explicit or implicit, not "static".
double log_growth(std::string_view integrator, const Oscillation& mode, double h, double duration);

/// A mode that at most doubles counts as one that holds: of methods without a limit that grow slowly (forward Euler,
/// heun, midpoint) this asks no more than a clip of that length needs.
inline constexpr double kMostGrowth = 2;

bool holds(std::string_view integrator, const Oscillation& mode, double h, double duration);

/// The largest step [s] up to which every step holds; infinity if there is no limit.
double largest_step(std::string_view integrator, const Oscillation& mode, double duration);

/// The step [s] below which the fixed-point iteration converges (fixed_point_rate = 1); infinity for omega = 0.
double largest_fixed_point_step(std::string_view integrator, const Oscillation& mode);

}  // namespace softreel::sim
