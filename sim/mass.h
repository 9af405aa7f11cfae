#pragma once
// The mass matrix M: lumped, one mass per vertex, or with the consistent one of some bodies.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/block_matrix.h"
#include "sim/energy_term.h"
#include "sim/linear_solver.h"
#include "sim/model.h"

namespace softreel::sim {

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
