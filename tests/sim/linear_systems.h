#pragma once
// Real systems for tests and benchmarks of linear solvers: the matrix of a step of a deformed body.
#include <array>
#include <span>
#include <vector>

#include "sim/grids.h"
#include "sim/incremental_potential.h"
#include "sim/linear_solver.h"
#include "sim/model_builder.h"
#include "tests/sim/derivatives.h"

namespace softreel::tests {

struct System {
  sim::Model model;
  sim::BlockMatrix A;
  Eigen::VectorXd b;
  Eigen::VectorXd x;               ///< positions that A was made at
  std::vector<std::uint8_t> held;  ///< 3n flags

  /// `residual`: one per body; must outlive the result.
  sim::LinearTargets targets(std::span<const double> residual) const { return {model.bodies, residual, &x, &held}; }

  /// The smallest eigenvalue of A is at least this: clamped Hessians only add to the masses, held rows are the
  /// identity.
  double smallest_eigenvalue() const { return std::min(1.0, model.masses.minCoeff()); }
};

/// A block of 1 x 0.5 x 0.5 m and 6 tetrahedra a cell, its vertices moved by up to `deformation` cells, two vertices
/// held; step h [s] of implicit Euler; a random right-hand side, zero where held.
inline System real_system(const std::array<int, 3>& cells, double young, double h = 1.0 / 120,
                          double deformation = 0.04) {
  using namespace sim;
  ModelBuilder builder;
  builder.add_solid("block", block_of_tets(Vec3(1, 0.5, 0.5), cells[0], cells[1], cells[2]),
                    {"stable-neo-hookean", young, 0.4, 1000});
  Pin pin;
  pin.vertices = {0, 1};
  builder.add_pin(std::move(pin));
  System s{builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {}, {}, {}, {}};
  Pins pins(s.model);
  IncrementalPotential phi(s.model, pins, terms_of(s.model, {}));
  s.x = s.model.x0 + random_vector(s.model.x0.size(), 0.5 * deformation / cells[1], 4);
  phi.stage().y_tilde = s.x;
  phi.stage().b = Eigen::VectorXd::Zero(s.x.size());
  phi.stage().a = 1 / h;
  phi.stage().beta = h * h;
  StepReport report;
  phi.hessian(s.x, Definiteness::kClamped, s.A, report);
  s.held = phi.held();
  s.b = random_vector(s.x.size(), 1, 5);
  pins.zero(s.b);
  return s;
}

inline System real_system(int cells, double young) { return real_system({2 * cells, cells, cells}, young); }

inline Eigen::MatrixXd dense(const sim::BlockMatrix& A) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(3 * A.rows(), 3 * A.rows());
  for (int i = 0; i < A.rows(); ++i)
    for (int k = A.row_start[static_cast<size_t>(i)]; k < A.row_start[static_cast<size_t>(i) + 1]; ++k)
      D.block<3, 3>(3 * i, 3 * A.column[static_cast<size_t>(k)]) = A.block(k);
  return D;
}

}  // namespace softreel::tests
