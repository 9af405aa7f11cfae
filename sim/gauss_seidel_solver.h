#pragma once
#include "sim/sor_solver.h"

namespace softreel::sim {

/// P = D + L: the relaxation with omega = 1.
class GaussSeidelSolver final : public SorSolver {
 public:
  explicit GaussSeidelSolver(const LinearSettings& settings = {}) : SorSolver("gauss-seidel", 1, settings) {}
};

}  // namespace softreel::sim
