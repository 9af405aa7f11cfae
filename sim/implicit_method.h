#pragma once
// An implicit integrator is only a prediction and a scale: each minimizes, per step,
//   1/2 |y - y_tilde|_M^2 + beta (E(y) + D(a y + b)/a).
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>

#include "sim/state.h"

namespace softreel::sim {

/// What a method asks the minimizer for.
struct Stage {
  Eigen::VectorXd y_tilde;  ///< 3n [m]
  double beta = 0;          ///< [s^2]
  double a = 0;             ///< the method's own velocity is v(y) = a y + b: a [1/s]
  Eigen::VectorXd b;        ///< 3n [m/s]
};

class ImplicitMethod {
 public:
  virtual ~ImplicitMethod() = default;
  virtual std::string_view name() const = 0;
  virtual int order() const = 0;
  /// Fills `stage` for a step of length h [s] from `state`.
  virtual void predict(const State& state, double h, Stage& stage) const = 0;
  /// Makes `state` the one at t + h, from the minimizer y.
  virtual void finish(const Eigen::VectorXd& y, double h, State& state) const = 0;
};

/// Backward Euler: y_tilde = x + h v, beta = h^2; v' = (y - x)/h. Order 1.
class ImplicitEuler final : public ImplicitMethod {
 public:
  std::string_view name() const override { return "implicit-euler"; }
  int order() const override { return 1; }
  void predict(const State& s, double h, Stage& stage) const override {
    stage.y_tilde = s.x + h * s.v;
    stage.beta = h * h;
    stage.a = 1 / h;
    stage.b = -s.x / h;
  }
  void finish(const Eigen::VectorXd& y, double h, State& s) const override {
    s.v = (y - s.x) / h;
    s.x = y;
    s.t += h;
  }
};

}  // namespace softreel::sim
