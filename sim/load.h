#pragma once
// Dead loads: forces that keep their size and direction while the body moves.
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// When a load acts: from `from`, rising in a straight line over `ramp`, until `until`.
struct LoadTimes {
  double from = 0;                                         ///< [s]; 0 without a ramp: it was there before the start
  double until = std::numeric_limits<double>::infinity();  ///< [s] > from
  double ramp = 0;                                         ///< [s] >= 0

  double at(double t) const;  ///< share of the load that acts at t, in [0, 1]
  bool change() const { return !always() || until < std::numeric_limits<double>::infinity(); }
  double mean(double t, double h) const;  ///< its mean over [t, t + h], exact; h = 0: that at t

 private:
  bool always() const { return from <= 0 && ramp <= 0; }
};

/// Forces [N] on vertices of the state.
struct NodalForces {
  std::vector<int> vertices;
  std::vector<Vec3> forces;  ///< one per vertex
};

/// A total force [N], shared out by mass: so the loaded part is accelerated as one, and the rule holds for inner
/// vertices and for points without a surface too. `masses`: of the whole state [kg].
NodalForces share_force(const Vec3& total, std::span<const int> vertices, const Eigen::VectorXd& masses);

/// Traction [Pa] on triangles (vertex indices of the state), constant over their rest areas: a third of each triangle's
/// force to each corner, which is exact for linear elements, for force and torque. `x`: rest positions, 3n [m].
NodalForces share_traction(const Vec3& traction, std::span<const Triangle> triangles, const Eigen::VectorXd& x);

/// E = -s f . x, s the mean of `times` over a step's length around the time at which forces are taken: the means of
/// successive steps tile the time, so the impulse of a load that begins or ends within a step is exact; elsewhere the
/// mean is its middle to second order.
std::unique_ptr<EnergyTerm> make_load(NodalForces forces, const LoadTimes& times);

}  // namespace softreel::sim
