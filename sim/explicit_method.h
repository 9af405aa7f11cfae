#pragma once
// Explicit integrators use only the acceleration and never assemble a matrix.
#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "sim/state.h"

namespace softreel::sim {

/// M^-1 f(x, v, t).
struct Acceleration {
  /// Writes the acceleration at `at`, 3n [m/s^2]; zero where held. What is held is put where it belongs at at.t.
  std::function<void(State& at, Eigen::VectorXd& acceleration)> evaluate;
  bool depends_on_velocity = false;

  void operator()(State& at, Eigen::VectorXd& acceleration) const { evaluate(at, acceleration); }
};

/// A method has `static constexpr MethodInfo kInfo`, which declares its name, order and what it needs, and an entry in
/// the table of integrators.cpp.
class ExplicitMethod {
 public:
  virtual ~ExplicitMethod() = default;
  /// Makes `state` the one at t + h, h [s].
  virtual void step(const Acceleration& acceleration, double h, State& state) = 0;

  /// Forgets earlier steps: the next one starts from (x, v) alone.
  virtual void forget() {}
  /// Step length and vectors of earlier steps, or nothing; `restore` goes on from them with the same bits.
  virtual std::vector<double> memory() const { return {}; }
  virtual void restore(std::span<const double>) {}
};

}  // namespace softreel::sim
