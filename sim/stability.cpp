#include "sim/stability.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "sim/integrators.h"

namespace softreel::sim {
namespace {

// A double eigenvalue of modulus 1, as at the end of a stable range, is known to the root of rounding only.
constexpr double kNoGrowth = 1 + 1e-6;
// Methods with a limit have it far beyond the first and below the second value of h omega.
constexpr double kSmall = 0.5, kLarge = 1e4;

/// The oscillator with the step 1.
struct Oscillator {
  double omega, xi;

  void step(Integrator& method, State& s) const {
    const Acceleration acceleration{
        [this](State& at, Eigen::VectorXd& a) { a = -2 * xi * omega * at.v - omega * omega * at.x; }, xi != 0};
    if (method.explicit_method) return method.explicit_method->step(acceleration, 1, s);
    Stage stage;
    method.implicit_method->predict(s, 1, acceleration, stage);
    if (stage.inertia == 0) throw std::invalid_argument("an equilibrium has no step to be stable or not");
    // inertia (y - y_tilde) + beta (omega^2 y + 2 xi omega (a y + b)) = 0.
    const double c = 2 * xi * omega;
    const Eigen::VectorXd y = (stage.inertia * stage.y_tilde - stage.beta * c * stage.b) /
                              (stage.inertia + stage.beta * (omega * omega + c * stage.a));
    method.implicit_method->finish(y, 1, s);
  }
};

std::vector<double> memory_of(const Integrator& m) {
  return m.explicit_method ? m.explicit_method->memory() : m.implicit_method->memory();
}

void restore(Integrator& m, const std::vector<double>& memory) {
  if (m.explicit_method)
    m.explicit_method->restore(memory);
  else
    m.implicit_method->restore(memory);
}

}  // namespace

std::vector<std::complex<double>> amplification(std::string_view integrator, double h_omega, double damping_ratio) {
  const Oscillator oscillator{h_omega, damping_ratio};
  Integrator method = make_integrator(integrator);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  State s{0, zero, zero};
  for (int i = 0; i < 2; ++i) oscillator.step(method, s);  // past what starts it
  const std::vector<double> rest = memory_of(method);      // step length, then zeros
  const size_t kept = rest.empty() ? 0 : rest.size() - 1;
  const auto n = static_cast<Eigen::Index>(2 + kept);
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index column = 0; column < n; ++column) {
    Eigen::VectorXd z = Eigen::VectorXd::Unit(n, column);
    s = {0, z.segment(0, 1), z.segment(1, 1)};
    std::vector<double> memory = rest;
    for (size_t k = 0; k < kept; ++k) memory[1 + k] = z(static_cast<Eigen::Index>(2 + k));
    restore(method, memory);
    oscillator.step(method, s);
    memory = memory_of(method);
    A(0, column) = s.x(0);
    A(1, column) = s.v(0);
    for (size_t k = 0; k < kept; ++k) A(static_cast<Eigen::Index>(2 + k), column) = memory[1 + k];
  }
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  return {values.begin(), values.end()};
}

double spectral_radius(std::string_view integrator, double h_omega, double damping_ratio) {
  double largest = 0;
  for (const auto& value : amplification(integrator, h_omega, damping_ratio))
    largest = std::max(largest, std::abs(value));
  return largest;
}

double fixed_point_rate(std::string_view integrator, double h_omega, double damping_ratio) {
  Integrator method = make_integrator(integrator);
  if (!method.implicit_method) throw std::invalid_argument("explicit methods iterate nothing");
  const Oscillator oscillator{h_omega, damping_ratio};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  State s{0, zero, zero};
  for (int i = 0; i < 2; ++i) oscillator.step(method, s);  // past what starts it
  Stage stage;
  method.implicit_method->predict(s, 1, {[](State& at, Eigen::VectorXd& a) { a = 0 * at.x; }, false}, stage);
  return stage.beta * (h_omega * h_omega + 2 * damping_ratio * h_omega * stage.a) / stage.inertia;
}

double stability_limit(std::string_view integrator) {
  double lo = kSmall, hi = kLarge;
  if (spectral_radius(integrator, lo) > kNoGrowth) return 0;
  if (spectral_radius(integrator, hi) <= kNoGrowth) return std::numeric_limits<double>::infinity();
  while (hi - lo > 1e-9 * hi) {
    const double middle = 0.5 * (lo + hi);
    (spectral_radius(integrator, middle) <= kNoGrowth ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace softreel::sim
