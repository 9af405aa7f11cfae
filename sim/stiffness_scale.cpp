#include "sim/stiffness_scale.h"

#include <algorithm>
#include <vector>

namespace softreel::sim {

Eigen::VectorXd stiffness_scale(std::span<const std::unique_ptr<EnergyTerm>> potentials, const Eigen::VectorXd& x) {
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(x.size() / 3);
  std::vector<double> blocks;
  for (const auto& term : potentials) {
    const int k = term->stencil_size();
    if (k == 0 || term->kind() == EnergyKind::kContact) continue;
    const auto stencils = term->stencils();
    const size_t elements = stencils.size() / static_cast<size_t>(k);
    blocks.resize(elements * static_cast<size_t>(hessian_doubles(k)));
    all_element_hessians(*term, x, 1.0, Definiteness::kClamped, blocks.data());
    const double* block = blocks.data();
    for (size_t e = 0; e < elements; ++e)
      for (int a = 0; a < k; ++a)
        for (int b = a; b < k; ++b, block += 9)
          if (a == b)
            stiffness(stencils[e * static_cast<size_t>(k) + static_cast<size_t>(a)]) +=
                std::max({block[0], block[4], block[8]});
  }
  return stiffness;
}

}  // namespace softreel::sim
