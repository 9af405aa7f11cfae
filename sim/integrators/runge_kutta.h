#pragma once
// Explicit Runge-Kutta methods for y' = f(t, y), each a table of coefficients (Hairer, Norsett, Wanner 1993, section
// II.1): k_i = f(t + c_i h, y + h sum_j a_ij k_j), y' = y + h sum_i b_i k_i.
#include <Eigen/Core>
#include <array>

#include "sim/catalogue.h"
#include "sim/explicit_method.h"

namespace softreel::sim {

template <size_t S>
struct Tableau {
  std::array<std::array<double, S>, S> a;
  std::array<double, S> b, c;
};

inline constexpr Tableau<1> kForwardEulerTableau = {{{{0}}}, {1}, {0}};
inline constexpr Tableau<2> kHeunTableau = {{{{0, 0}, {1, 0}}}, {0.5, 0.5}, {0, 1}};
inline constexpr Tableau<2> kMidpointTableau = {{{{0, 0}, {0.5, 0}}}, {0, 1}, {0, 0.5}};
inline constexpr Tableau<4> kRk4Tableau = {{{{0, 0, 0, 0}, {0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 1, 0}}},
                                           {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6},
                                           {0, 0.5, 0.5, 1}};

/// One step of a system of first order; f(t, y, dy) writes dy = f(t, y). `k`: scratch, kept by the caller.
template <size_t S, class Function>
void runge_kutta_step(const Tableau<S>& tableau, const Function& f, double t, double h, Eigen::VectorXd& y,
                      std::array<Eigen::VectorXd, S>& k) {
  Eigen::VectorXd stage;
  for (size_t i = 0; i < S; ++i) {
    stage = y;
    for (size_t j = 0; j < i; ++j)
      if (tableau.a[i][j] != 0) stage += h * tableau.a[i][j] * k[j];
    f(t + tableau.c[i] * h, stage, k[i]);
  }
  for (size_t i = 0; i < S; ++i) y += h * tableau.b[i] * k[i];
}

/// The same for motion, as the system y = (x, v), y' = (v, a(x, v, t)).
template <const auto& kTableau>
class RungeKutta : public ExplicitMethod {
 public:
  void step(const Acceleration& acceleration, double h, State& s) override {
    const Eigen::Index n = s.x.size();
    y_.resize(2 * n);
    y_ << s.x, s.v;
    const auto f = [&](double t, const Eigen::VectorXd& y, Eigen::VectorXd& dy) {
      at_.t = t;
      at_.x = y.head(n);
      at_.v = y.tail(n);
      acceleration(at_, a_);
      dy.resize(2 * n);
      dy << at_.v, a_;
    };
    runge_kutta_step(kTableau, f, s.t, h, y_, k_);
    s.x = y_.head(n);
    s.v = y_.tail(n);
    s.t += h;
  }

 private:
  Eigen::VectorXd y_, a_;
  State at_;
  std::array<Eigen::VectorXd, kTableau.b.size()> k_;
};

struct ForwardEuler final : RungeKutta<kForwardEulerTableau> {
  static constexpr MethodInfo kInfo = {"forward-euler", "gains energy at any step; for comparison only",
                                       "1 gradient a step", "Hairer, Norsett, Wanner 1993, section I.7", 1};
};
struct Heun final : RungeKutta<kHeunTableau> {
  static constexpr MethodInfo kInfo = {"heun", "gains energy slowly: (h omega)^4/4 of it a step", "2 gradients a step",
                                       "Heun 1900; Hairer, Norsett, Wanner 1993, section II.1", 2};
};
struct Midpoint final : RungeKutta<kMidpointTableau> {
  static constexpr MethodInfo kInfo = {"midpoint", "gains energy slowly: (h omega)^4/4 of it a step",
                                       "2 gradients a step", "Runge 1895; Hairer, Norsett, Wanner 1993, section II.1",
                                       2};
};
struct Rk4 final : RungeKutta<kRk4Tableau> {
  static constexpr MethodInfo kInfo = {"rk4", "accurate; stable while h omega < 2.83, and damps there",
                                       "4 gradients a step", "Kutta 1901; Hairer, Norsett, Wanner 1993, section II.1",
                                       4};
};

}  // namespace softreel::sim
