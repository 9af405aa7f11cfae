#pragma once
// The two symplectic Euler methods (Hairer, Lubich, Wanner 2006, section I.1.2).
#include "sim/catalogue.h"
#include "sim/explicit_method.h"

namespace softreel::sim {

/// v' = v + h a(x, v, t), x' = x + h v'.
class SymplecticEuler final : public ExplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"symplectic-euler", "velocity first; stable while h omega < 2",
                                       "1 gradient a step", "Hairer, Lubich, Wanner 2006, section I.1.2", 1};
  void step(const Acceleration& acceleration, double h, State& s) override {
    acceleration(s, a_);
    s.v += h * a_;
    s.x += h * s.v;
    s.t += h;
  }

 private:
  Eigen::VectorXd a_;
};

/// x' = x + h v, v' = v + h a(x', v, t').
class SymplecticEulerPosition final : public ExplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"symplectic-euler-position", "position first; stable while h omega < 2",
                                       "1 gradient a step", "Hairer, Lubich, Wanner 2006, section I.1.2", 1};
  void step(const Acceleration& acceleration, double h, State& s) override {
    s.x += h * s.v;
    s.t += h;
    acceleration(s, a_);
    s.v += h * a_;
  }

 private:
  Eigen::VectorXd a_;
};

}  // namespace softreel::sim
