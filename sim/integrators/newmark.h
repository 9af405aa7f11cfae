#pragma once
#include "sim/catalogue.h"
#include "sim/implicit_method.h"

namespace softreel::sim {

/// Newmark's method of average acceleration, the trapezoid rule: y_tilde = x + h v + h^2/4 M^-1 f(x, v),
/// beta = h^2/4; x' = y, v' = 2 (y - x)/h - v.
class Newmark final : public ImplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"newmark", "no damping of its own; can gain energy on stiff nonlinear motion",
                                       "1 minimization (gradient, Hessian) and 1 gradient a step",
                                       "Newmark 1959; Hughes 2000, section 9.1", 2};
  void predict(const State& s, double h, const Acceleration& acceleration, Stage& stage) override {
    at_ = s;
    acceleration(at_, a_);
    stage.y_tilde = s.x + h * s.v + 0.25 * h * h * a_;
    stage.beta = 0.25 * h * h;
    stage.a = 2 / h;
    stage.b = -2 / h * s.x - s.v;
  }
  void finish(const Eigen::VectorXd& y, double h, State& s) override {
    s.v = 2 / h * (y - s.x) - s.v;
    s.x = y;
    s.t += h;
  }

 private:
  State at_;
  Eigen::VectorXd a_;
};

}  // namespace softreel::sim
