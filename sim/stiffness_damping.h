#pragma once
// Rayleigh's stiffness-proportional damping, D(v) = beta/2 v^T K v.
#include <memory>

#include "sim/energy_term.h"

namespace softreel::sim {

/// K is the clamped Hessian of `elastic` at the predicted positions of each step (lagged), kept element by element: no
/// matrix is assembled, so explicit integrators can use it too. beta [s] >= 0. `elastic` must outlive the term.
std::unique_ptr<EnergyTerm> make_stiffness_damping(const EnergyTerm& elastic, double beta);

}  // namespace softreel::sim
