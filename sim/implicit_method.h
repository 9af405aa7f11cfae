#pragma once
// An implicit integrator is only a prediction and a scale: each minimizes, per step,
//   inertia/2 |y - y_tilde|_M^2 + beta (E(y) + D(a y + b)/a).
#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/explicit_method.h"
#include "sim/state.h"

namespace softreel::sim {

/// What a method asks the minimizer for.
struct Stage {
  Eigen::VectorXd y_tilde;  ///< 3n [m]
  double inertia = 1;       ///< 0: equilibrium, mass and velocity do not count
  double beta = 0;          ///< [s^2]
  double a = 0;             ///< the method's own velocity is v(y) = a y + b: a [1/s]; 0: there is none
  Eigen::VectorXd b;        ///< 3n [m/s]
};

/// A method has `static constexpr MethodInfo kInfo`, which declares its name, order and what it needs, and an entry in
/// the table of integrators.cpp.
class ImplicitMethod {
 public:
  virtual ~ImplicitMethod() = default;
  /// Where in the step y lies: y = x + fraction (x' - x). Forces are taken there.
  virtual double fraction() const { return 1; }
  /// Is x' = y? Then a step is as free of crossings as its solve.
  virtual bool ends_at_solution() const { return fraction() == 1; }
  /// Fills `stage` for a step of length h [s] from `state`.
  virtual void predict(const State& state, double h, const Acceleration& acceleration, Stage& stage) = 0;
  /// Makes `state` the one at t + h, from the minimizer y.
  virtual void finish(const Eigen::VectorXd& y, double h, State& state) = 0;

  /// As in ExplicitMethod.
  virtual void forget() {}
  virtual std::vector<double> memory() const { return {}; }
  virtual void restore(std::span<const double>) {}
};

}  // namespace softreel::sim
