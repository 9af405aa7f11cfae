#pragma once
// Dashpots along springs.
#include <memory>
#include <vector>

#include "sim/springs.h"

namespace softreel::sim {

/// Viscous damping along the springs, D(v) = c/2 (d . (v_a - v_b))^2, c [N s/m] >= 0; the direction d is taken at
/// the predicted positions of each step.
std::unique_ptr<EnergyTerm> make_spring_damping(const std::vector<Spring>& springs, double damping);

}  // namespace softreel::sim
