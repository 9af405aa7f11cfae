#pragma once
// Terms that act on every vertex by its mass: gravity and drag.
#include <Eigen/Core>
#include <memory>

#include "sim/energy_term.h"

namespace softreel::sim {

/// E = -sum m g . x; `masses` [kg] per vertex, `gravity` [m/s^2].
std::unique_ptr<EnergyTerm> make_gravity(const Eigen::VectorXd& masses, const Eigen::Vector3d& gravity);

/// D(v) = rate/2 sum m |v|^2, deceleration rate * v: air drag and Rayleigh's mass-proportional part; rate [1/s] >= 0.
std::unique_ptr<EnergyTerm> make_drag(const Eigen::VectorXd& masses, double rate);

}  // namespace softreel::sim
