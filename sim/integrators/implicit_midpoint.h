#pragma once
#include "sim/catalogue.h"
#include "sim/implicit_method.h"

namespace softreel::sim {

/// y is the middle of the step: y_tilde = x + h/2 v, beta = h^2/4; x' = 2y - x, v' = 4 (y - x)/h - v.
class ImplicitMidpoint final : public ImplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"implicit-midpoint", "keeps angular momentum; can gain energy on stiff motion",
                                       "1 minimization a step (gradient, Hessian)",
                                       "Hairer, Lubich, Wanner 2006, section II.1.3", 2};
  double fraction() const override { return 0.5; }
  void predict(const State& s, double h, const Acceleration&, Stage& stage) override {
    stage.y_tilde = s.x + 0.5 * h * s.v;
    stage.beta = 0.25 * h * h;
    stage.a = 2 / h;
    stage.b = -2 / h * s.x;
  }
  void finish(const Eigen::VectorXd& y, double h, State& s) override {
    s.v = 4 / h * (y - s.x) - s.v;
    s.x = 2 * y - s.x;
    s.t += h;
  }
};

}  // namespace softreel::sim
