#pragma once
// The mass matrix M: lumped, one mass per vertex, or with the consistent one of some bodies.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/block_matrix.h"
#include "sim/energy_term.h"
#include "sim/linear_solver.h"
#include "sim/mesh.h"
#include "sim/model.h"

namespace softreel::sim {

/// What the consistent mass matrix of linear elements has over the lumped one, as the quadratic form
/// q^T (M_consistent - M_lumped) q / 2: m/(K (K + 1)) (1 + delta_ij) instead of m/K delta_ij for an element of K
/// corners and mass m (Hughes 2000, section 7.3.2). It is negative semi-definite; the sum is positive definite.
/// `density`: [kg/m^3] of a solid, [kg/m^2] of a sheet; vertex i of `rest` is vertex first_vertex + i of the state.
std::unique_ptr<EnergyTerm> make_mass_correction(const TetMesh& rest, double density, int first_vertex);
std::unique_ptr<EnergyTerm> make_mass_correction(const TriangleMesh& rest, double density, int first_vertex);

class MassMatrix {
 public:
  /// `model` and `held` (3n flags) must outlive this.
  MassMatrix(const Model& model, const std::vector<std::uint8_t>& held);

  /// q^T M q / 2; of a velocity [J].
  double energy(const Eigen::VectorXd& q) const;
  /// out += M q.
  void add_product(const Eigen::VectorXd& q, Eigen::VectorXd& out) const;
  /// f := M^-1 f for what is free, 0 where held. With lumped masses alone nothing is factorized.
  void solve(Eigen::VectorXd& f);

 private:
  const Model& model_;
  const std::vector<std::uint8_t>& held_;
  std::unique_ptr<LinearSolver> solver_;  // of a consistent mass; made when it is needed
  BlockMatrix M_;
  Eigen::VectorXd scratch_;
};

}  // namespace softreel::sim
