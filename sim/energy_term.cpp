#include "sim/energy_term.h"

#include <algorithm>

#include "sim/parallel.h"

namespace softreel::sim {

void all_element_hessians(const EnergyTerm& term, const Eigen::VectorXd& q, double scale, Definiteness definiteness,
                          double* blocks) {
  constexpr int kRange = 64;
  const int stencils = stencil_count(term), doubles = hessian_doubles(term.stencil_size());
  const int ranges = (stencils + kRange - 1) / kRange;
  const auto one = [&](int r) {
    const StencilRange range{r * kRange, std::min(kRange, stencils - r * kRange)};
    term.element_hessians(q, scale, definiteness, range,
                          blocks + static_cast<size_t>(range.first) * static_cast<size_t>(doubles));
  };
  if (stencils >= static_cast<int>(Work::kElement) && threads() > 1) return parallel_tasks(ranges, one);
  for (int r = 0; r < ranges; ++r) one(r);
}

}  // namespace softreel::sim
