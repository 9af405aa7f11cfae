#pragma once
// Explicit integrators use only the acceleration and never assemble a matrix.
#include <Eigen/Core>
#include <functional>
#include <string_view>

#include "sim/state.h"

namespace softreel::sim {

/// M^-1 f(x, v, t), 3n [m/s^2]; zero where held.
using Acceleration = std::function<void(const State& at, Eigen::VectorXd& acceleration)>;

class ExplicitMethod {
 public:
  virtual ~ExplicitMethod() = default;
  virtual std::string_view name() const = 0;
  virtual int order() const = 0;
  virtual void step(const Acceleration& acceleration, double h, State& state) = 0;
};

/// v' = v + h a(x, v), x' = x + h v'. Order 1; for a linear oscillator stable while h omega < 2.
class SymplecticEuler final : public ExplicitMethod {
 public:
  std::string_view name() const override { return "symplectic-euler"; }
  int order() const override { return 1; }
  void step(const Acceleration& acceleration, double h, State& s) override {
    acceleration(s, a_);
    s.v += h * a_;
    s.x += h * s.v;
    s.t += h;
  }

 private:
  Eigen::VectorXd a_;
};

}  // namespace softreel::sim
