#pragma once
// Step 5 of field.h: systems (m M + s K) y = b with some entries of y given.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/field_assembly.h"

namespace softreel::sim {

/// Sparse Cholesky (Eigen's simplicial L L^T after approximate minimum degree) of the rows that are free. In two
/// dimensions its factor is small, and one thread gives the same bits as many. Symbolic work once, numeric work only
/// when m or s differ from the last ones.
class FieldSolver {
 public:
  /// `held`: n flags, entries of y that are given. K and M must stay.
  FieldSolver(const ScalarMatrix& K, const ScalarMatrix& M, const std::vector<std::uint8_t>& held);
  ~FieldSolver();

  /// Replaces the free entries of y by the solution; reads the held ones. False if the matrix is not positive definite.
  bool solve(double m, double s, const Eigen::VectorXd& b, Eigen::VectorXd& y);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softreel::sim
