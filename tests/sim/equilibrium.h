#pragma once
// A small static solver for tests of elements: independent of the integrators.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <limits>
#include <vector>

#include "tests/sim/derivatives.h"

namespace softreel::tests {

/// Minimizes value(x) - load.x over the coordinates that are not held (3n flags): Newton's method with the clamped
/// Hessian and halved steps, until a step is rounding of `length` [m]. `x`: start, then result. Returns the last step
/// over length (a number that a test can bound), or infinity if the solve broke down.
inline double find_equilibrium(const sim::EnergyTerm& term, Eigen::VectorXd& x, const std::vector<char>& held,
                               const Eigen::VectorXd& load, double length) {
  const int k = term.stencil_size();
  const size_t elements = term.stencils().size() / static_cast<size_t>(k);
  const auto objective = [&](const Eigen::VectorXd& y) { return term.value(y) - load.dot(y); };
  double step = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 200; ++iteration) {
    Eigen::VectorXd g = -load;
    term.add_gradient(x, g);
    const std::vector<double> blocks = all_blocks(term, x, sim::Definiteness::kClamped);
    std::vector<Eigen::Triplet<double>> entries;
    for (size_t e = 0; e < elements; ++e) {
      const Eigen::MatrixXd H = element_matrix(blocks, e, k);
      for (int r = 0; r < 3 * k; ++r) {
        const int i = 3 * term.stencils()[e * static_cast<size_t>(k) + static_cast<size_t>(r / 3)] + r % 3;
        for (int c = 0; c < 3 * k; ++c) {
          const int j = 3 * term.stencils()[e * static_cast<size_t>(k) + static_cast<size_t>(c / 3)] + c % 3;
          if (!held[static_cast<size_t>(i)] && !held[static_cast<size_t>(j)] && i >= j)
            entries.emplace_back(i, j, H(r, c));
        }
      }
    }
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (held[static_cast<size_t>(i)]) {
        entries.emplace_back(i, i, 1.0);
        g(i) = 0;
      }
    Eigen::SparseMatrix<double> H(x.size(), x.size());
    H.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(H);
    if (solver.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const Eigen::VectorXd d = -solver.solve(g);
    step = d.cwiseAbs().maxCoeff() / length;
    double s = 1;
    // Near the end the decrease drowns in rounding: short steps are taken as they are.
    if (step > 1e-6)
      while (s > 1e-8 && !(objective(x + s * d) <= objective(x))) s *= 0.5;
    x += s * d;
    if (!(step > 1e-13)) break;
  }
  return step;
}

}  // namespace softreel::tests
