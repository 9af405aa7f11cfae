#pragma once
// How far an explicit method may step a field, found from the method itself: it is run on the one mode that grows
// first.
#include <string_view>

namespace softreel::sim {

/// Factor by which one step of length h [s] multiplies the fastest mode in the long run, whose eigenvalue is
/// Field::largest_eigenvalue: of y' = -eigenvalue y for heat, of y'' = -eigenvalue y for wave. At most 1 (but for
/// rounding) where the method is stable; 1 for implicit methods, which need no limit. Of waves it is their
/// spectral_radius (stability.h). Throws std::invalid_argument for
/// unknown names.
double growth_of_a_step(std::string_view equation, std::string_view integrator, double eigenvalue, double h);

/// Whether the fastest mode at most doubles over `duration` [s] in steps of h. Of methods that have no limit but grow
/// slowly (forward Euler, heun, midpoint on waves) this asks no more than a clip of that length needs.
bool step_holds(std::string_view equation, std::string_view integrator, double eigenvalue, double h, double duration);

/// Least number of equal steps in `interval` [s] that hold over `duration`; 0 if not even `most` do.
int steps_that_hold(std::string_view equation, std::string_view integrator, double eigenvalue, double interval,
                    double duration, int most);

}  // namespace softreel::sim
