#pragma once
// A force against the velocity of every vertex, by its mass.
#include <Eigen/Core>
#include <memory>

#include "sim/energy_term.h"

namespace softreel::sim {

/// D(v) = rate/2 sum m |v|^2, deceleration rate * v: air drag and Rayleigh's mass-proportional part; rate [1/s] >= 0.
std::unique_ptr<EnergyTerm> make_drag(const Eigen::VectorXd& masses, double rate);

}  // namespace softreel::sim
