#include "sim/field_stability.h"

#include <algorithm>
#include <cmath>

#include "sim/integrators.h"
#include "sim/stability.h"

namespace softreel::sim {
namespace {

constexpr double kMostGrowth = 2;

// What spectral_radius knows of a double eigenvalue of modulus 1.
constexpr double kNoGrowth = 1 + 1e-6;

}  // namespace

double growth_of_a_step(std::string_view equation, std::string_view integrator, double eigenvalue, double h) {
  if (is_implicit(integrator) || !(eigenvalue > 0)) return 1;
  if (equation != "heat") return spectral_radius(integrator, h * std::sqrt(eigenvalue));
  // y' = -eigenvalue y is what the velocity does under a drag.
  State s{0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
  const Acceleration drag{[&](State& at, Eigen::VectorXd& a) { a = -eigenvalue * at.v; }, true};
  make_integrator(integrator).explicit_method->step(drag, h, s);
  return std::abs(s.v(0));
}

bool step_holds(std::string_view equation, std::string_view integrator, double eigenvalue, double h, double duration) {
  const double growth = growth_of_a_step(equation, integrator, eigenvalue, h);
  return growth <= kNoGrowth || std::log(growth) * duration / h <= std::log(kMostGrowth);
}

int steps_that_hold(std::string_view equation, std::string_view integrator, double eigenvalue, double interval,
                    double duration, int most) {
  const auto holds = [&](int steps) {
    return step_holds(equation, integrator, eigenvalue, interval / steps, duration);
  };
  int high = 1;
  while (high < most && !holds(high)) high = std::min(2 * high, most);
  if (!holds(high)) return 0;
  int low = high / 2;  // does not hold
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace softreel::sim
