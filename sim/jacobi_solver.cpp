#include "sim/jacobi_solver.h"

#include <cmath>

#include "sim/parallel.h"

namespace softreel::sim {

void JacobiSolver::solve_splitting(const Eigen::VectorXd& r, Eigen::VectorXd& d) const {
  parallel_for(static_cast<int>(r.size()), Work::kVector, [&](int i) { d(i) = r(i) / diagonal()(i); });
}

void JacobiSolver::multiply_rest(const Eigen::VectorXd& d, Eigen::VectorXd& Nd) const {
  parallel_for(matrix().rows(), Work::kRow, [&](int i) {
    matrix().multiply_rows(i, 1, d, Nd);
    Nd.segment<3>(3 * i) = diagonal().segment<3>(3 * i).cwiseProduct(d.segment<3>(3 * i)) - Nd.segment<3>(3 * i);
  });
}

/// |D^-1/2 r|: in it the sweep r' = N D^-1 r is the symmetric matrix D^-1/2 N D^-1/2.
double JacobiSolver::watched_norm(const Eigen::VectorXd& r) const {
  return std::sqrt(
      parallel_sum(static_cast<int>(r.size()), Work::kVector, [&](int i) { return r(i) * r(i) / diagonal()(i); }));
}

/// Under powers of a symmetric matrix the factor from one power to the next never falls (|G^k r|^2 <= |G^(k-1) r|
/// |G^(k+1) r|, by Cauchy and Schwarz), and tends to the radius from below: one factor above 1 proves divergence. A few
/// more sweeps let it settle, for the message.
bool JacobiSolver::diverges(const ConvergenceWatch& watch) const {
  constexpr double kProof = 1 + 1e-10, kSettled = 1e-3, kFar = 1e30;
  if (!(watch.factor() > kProof)) return false;
  return watch.factor() < watch.factor(1) * (1 + kSettled) || watch.growth() > kFar;
}

std::string JacobiSolver::divergence(double radius) const {
  return "jacobi does not converge here: the spectral radius of I - P^-1 A is about " + figures(radius, 3) +
         ", it must be below 1; take gauss-seidel, sor, cg or cholesky";
}

}  // namespace softreel::sim
