#pragma once
// Verlet's method in its position form, x'' = 2x - x_prev + h^2 a, and leapfrog, with velocities at half steps. Both
// move alike; they differ in what they keep. (Hairer, Lubich, Wanner 2003, Acta Numerica, sections 1.2 to 1.5.)
//
// A force that depends on velocity needs v at the same time as x, which comes half a step later. It is predicted from
// the half step before, v = v_half + h/2 a(x, v_half): wrong by O(h^2), so the order stays 2.
#include "sim/catalogue.h"
#include "sim/explicit_method.h"
#include "sim/step_history.h"

namespace softreel::sim {

/// The acceleration at s.x, s.t and the velocity there, from the velocity `v_half` of half a step earlier.
inline void end_of_half_step(const Acceleration& acceleration, double h, const Eigen::VectorXd& v_half, State& s,
                             Eigen::VectorXd& a) {
  s.v = v_half;
  acceleration(s, a);
  if (acceleration.depends_on_velocity) {
    s.v = v_half + 0.5 * h * a;
    acceleration(s, a);
  }
  s.v = v_half + 0.5 * h * a;
}

/// Keeps the last positions. Velocities are central differences: (x_next - x_prev)/2h = (x - x_prev)/h + h/2 a.
class Verlet final : public ExplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"verlet", "keeps energy over long times; stable while h omega < 2",
                                       "1 gradient a step (2 with damping), 1 previous state",
                                       "Verlet 1967; Hairer, Lubich, Wanner 2003, section 1.2", 2};
  void step(const Acceleration& acceleration, double h, State& s) override {
    auto& [x_prev, a] = last_.vectors;
    const bool restart = last_.h != h;
    if (restart) acceleration(s, a);
    if (restart)
      next_ = s.x + h * s.v + 0.5 * h * h * a;
    else
      next_ = 2 * s.x - x_prev + h * h * a;
    x_prev = s.x;
    s.x = next_;
    s.t += h;
    v_half_ = (s.x - x_prev) / h;
    end_of_half_step(acceleration, h, v_half_, s, a);
    last_.h = h;
  }
  void forget() override { last_.h = 0; }
  std::vector<double> memory() const override { return last_.memory(); }
  void restore(std::span<const double> saved) override { last_.restore(saved); }

 private:
  StepHistory<2> last_;  // x one step ago, a now
  Eigen::VectorXd next_, v_half_;
};

/// Keeps the velocity of the next half step; the first half step is one of Euler's.
class Leapfrog final : public ExplicitMethod {
 public:
  static constexpr MethodInfo kInfo = {"leapfrog", "keeps energy over long times; stable while h omega < 2",
                                       "1 gradient a step (2 with damping), 1 half-step velocity",
                                       "Hairer, Lubich, Wanner 2003, section 1.5", 2};
  void step(const Acceleration& acceleration, double h, State& s) override {
    auto& [v_half] = last_.vectors;
    if (last_.h != h) {
      acceleration(s, a_);
      v_half = s.v + 0.5 * h * a_;
    }
    s.x += h * v_half;
    s.t += h;
    end_of_half_step(acceleration, h, v_half, s, a_);
    v_half = s.v + 0.5 * h * a_;
    last_.h = h;
  }
  void forget() override { last_.h = 0; }
  std::vector<double> memory() const override { return last_.memory(); }
  void restore(std::span<const double> saved) override { last_.restore(saved); }

 private:
  StepHistory<1> last_;
  Eigen::VectorXd a_;
};

}  // namespace softreel::sim
