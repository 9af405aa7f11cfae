#pragma once
// Ralston's method: of the explicit methods of order 2 with two stages the one with the least bound on its local error
// (Ralston 1962, "Runge-Kutta methods with minimum error bounds").
#include "sim/integrators/runge_kutta.h"

namespace softreel::sim {

inline constexpr Tableau<2> kRalstonTableau = {{{{0, 0}, {2.0 / 3, 0}}}, {0.25, 0.75}, {0, 2.0 / 3}};

struct Ralston final : RungeKutta<kRalstonTableau> {
  static constexpr MethodInfo kInfo = {"ralston", "the least error of two stages; gains energy slowly",
                                       "2 gradients a step", "Ralston 1962", 2};
};

}  // namespace softreel::sim
