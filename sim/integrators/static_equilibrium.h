#pragma once
#include "sim/catalogue.h"
#include "sim/implicit_method.h"

namespace softreel::sim {

/// Minimizes E alone: mass, velocity and damping do not count. Time only says how much of the loads is there.
class StaticEquilibrium final : public ImplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"static", "equilibrium; gravity and loads grow to their full size over the clip",
                                       "1 minimization a load step (gradient, Hessian)",
                                       "Bonet, Wood 2008, section 9.6"};
  void predict(const State& s, double, const Acceleration&, Stage& stage) override {
    stage.y_tilde = s.x;
    stage.inertia = 0;
    stage.beta = 1;
    stage.a = 0;
  }
  void finish(const Eigen::VectorXd& y, double h, State& s) override {
    s.v.setZero();
    s.x = y;
    s.t += h;
  }
};

}  // namespace softreel::sim
