#pragma once
// Weight: a force on every vertex by its mass.
#include <Eigen/Core>
#include <memory>

#include "sim/energy_term.h"

namespace softreel::sim {

/// E = -sum m g . x; `masses` [kg] per vertex, `gravity` [m/s^2].
std::unique_ptr<EnergyTerm> make_gravity(const Eigen::VectorXd& masses, const Eigen::Vector3d& gravity);

}  // namespace softreel::sim
