#include "sim/ldlt_solver.h"

#include <cmath>
#include <limits>

#include "sim/linear_input.h"

namespace softreel::sim {

void LdltSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  factor_.factorize(A);
}

LinearReport LdltSolver::solve(const Eigen::VectorXd& b, const LinearTargets&, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "ldlt";
  factor_.solve(b, x, report);
  if (!report.ok) return report;
  // A definite matrix leaves a backward error of some eps (Higham 2002, theorem 10.3); half of the digits are lost only
  // where small pivots have let the factor grow.
  double largest = 0;
  for (double v : A_->values) largest = std::max(largest, std::abs(v));
  residual_of(*A_, b, x, r_);
  const double backward = norm(r_) / (largest * norm(x) + norm(b));
  if (backward > std::sqrt(std::numeric_limits<double>::epsilon())) {
    report.ok = false;
    report.reason = "the matrix is indefinite and ldlt, which does not pivot, loses its digits; take lu";
  }
  return report;
}

std::size_t LdltSolver::bytes() const { return factor_.bytes() + sizeof(double) * static_cast<size_t>(r_.size()); }

}  // namespace softreel::sim
