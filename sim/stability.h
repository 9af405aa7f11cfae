#pragma once
// Linear stability of the integrators, computed from the methods themselves.
#include <complex>
#include <string_view>
#include <vector>

namespace softreel::sim {

/// Eigenvalues of the one-step matrix of an integrator for x'' + 2 xi omega x' + omega^2 x = 0 (Hughes 2000, section
/// 9.1.3). The matrix is found by letting the method take one step from each unit vector of what it keeps: x, v, and
/// the vectors of earlier steps. `h_omega` = h omega >= 0, `damping_ratio` = xi, negative for one that
/// grows by itself. Throws std::invalid_argument for
/// an unknown name and for "static", which has no step.
std::vector<std::complex<double>> amplification(std::string_view integrator, double h_omega, double damping_ratio = 0);

/// The largest modulus of `amplification`: by so much a step multiplies what oscillates, in the long run.
double spectral_radius(std::string_view integrator, double h_omega, double damping_ratio = 0);

/// The largest h omega for which the undamped oscillator does not grow: 0 if it always grows, infinity if it never
/// does.
double stability_limit(std::string_view integrator);

/// By how much a minimizer that divides by the mass alone (`fixed-point`) multiplies its error in this oscillator, per
/// iteration: beta (omega^2 + 2 xi omega a)/inertia of the method's own stage. It converges below 1. Throws
/// std::invalid_argument for methods that are not implicit, and for "static".
double fixed_point_rate(std::string_view integrator, double h_omega, double damping_ratio = 0);

}  // namespace softreel::sim
