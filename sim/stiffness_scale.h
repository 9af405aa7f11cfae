#pragma once
// How stiff a scene is at each of its vertices.
#include <Eigen/Core>
#include <memory>
#include <span>

#include "sim/energy_term.h"

namespace softreel::sim {

/// Per vertex, the largest diagonal entry of the clamped Hessian of `potentials` at x (3n) [N/m], summed over its
/// elements; contact, whose stiffness comes and goes, is left out. n numbers.
Eigen::VectorXd stiffness_scale(std::span<const std::unique_ptr<EnergyTerm>> potentials, const Eigen::VectorXd& x);

}  // namespace softreel::sim
