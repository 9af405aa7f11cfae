#pragma once
#include "sim/catalogue.h"
#include "sim/implicit_method.h"

namespace softreel::sim {

/// Backward Euler: y_tilde = x + h v, beta = h^2; x' = y, v' = (y - x)/h.
class ImplicitEuler final : public ImplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"implicit-euler", "calm at any stiffness; damps motion of a few steps' period",
                                       "1 minimization a step (gradient, Hessian)",
                                       "Baraff, Witkin 1998; Gast et al. 2015", 1};
  void predict(const State& s, double h, const Acceleration&, Stage& stage) override {
    stage.y_tilde = s.x + h * s.v;
    stage.beta = h * h;
    stage.a = 1 / h;
    stage.b = -s.x / h;
  }
  void finish(const Eigen::VectorXd& y, double h, State& s) override {
    s.v = (y - s.x) / h;
    s.x = y;
    s.t += h;
  }
};

}  // namespace softreel::sim
