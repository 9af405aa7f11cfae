#pragma once
#include "sim/catalogue.h"
#include "sim/integrators/newmark.h"
#include "sim/step_history.h"

namespace softreel::sim {

/// Two-step backward differences with steps of any length: y_tilde = xh + g vh, beta = g^2, g = h (1 + r)/(1 + 2r),
/// xh = ((1 + r)^2 x - r^2 x_prev)/(1 + 2r), vh likewise, r = h/h_prev; x' = y, v' = (y - xh)/g. The first step is one
/// of Newmark's, and so is one that is more than 2.4 times as long as the one before it.
class Bdf2 final : public ImplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"bdf2", "damps less than implicit-euler; calm on stiff motion",
                                       "1 minimization a step (gradient, Hessian), 1 previous state",
                                       "Hairer, Norsett, Wanner 1993, section III.5; Choi, Ko 2002", 2};
  void predict(const State& s, double h, const Acceleration& acceleration, Stage& stage) override {
    starting_ = last_.h == 0 || h > kLargestRatio * last_.h;
    if (starting_) return start_.predict(s, h, acceleration, stage);
    const double r = h / last_.h, p = (1 + r) * (1 + r) / (1 + 2 * r), q = r * r / (1 + 2 * r);
    g_ = h * (1 + r) / (1 + 2 * r);
    xh_ = p * s.x - q * last_.vectors[0];
    stage.y_tilde = xh_ + g_ * (p * s.v - q * last_.vectors[1]);
    stage.beta = g_ * g_;
    stage.a = 1 / g_;
    stage.b = -xh_ / g_;
  }
  void finish(const Eigen::VectorXd& y, double h, State& s) override {
    last_.vectors = {s.x, s.v};
    last_.h = h;
    if (starting_) return start_.finish(y, h, s);
    s.v = (y - xh_) / g_;
    s.x = y;
    s.t += h;
  }
  void forget() override { last_.h = 0; }
  std::vector<double> memory() const override { return last_.memory(); }
  void restore(std::span<const double> saved) override { last_.restore(saved); }

 private:
  // Steps that grow faster than by 1 + sqrt(2) make the method unstable (Grigorieff 1983).
  static constexpr double kLargestRatio = 2.4;

  StepHistory<2> last_;  // x and v one step ago
  Newmark start_;
  bool starting_ = true;
  double g_ = 0;
  Eigen::VectorXd xh_;
};

}  // namespace softreel::sim
