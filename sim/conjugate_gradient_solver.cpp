#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/linear_solver.h"
#include "sim/parallel.h"

namespace softreel::sim {
namespace {

double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b, int first = 0, int count = -1) {
  if (count < 0) count = static_cast<int>(a.size()) - first;
  return parallel_sum(count, [&](int i) { return a(first + i) * b(first + i); });
}

bool within(const Eigen::VectorXd& r, const LinearTargets& targets) {
  for (size_t b = 0; b < targets.bodies.size(); ++b) {
    const BodyRange& body = targets.bodies[b];
    const double squared = dot(r, r, 3 * body.first, 3 * body.count);
    if (!(squared <= targets.residual[b] * targets.residual[b])) return false;
  }
  return true;
}

}  // namespace

void ConjugateGradientSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  inverse_diagonal_.resize(9 * static_cast<size_t>(A.rows()));
  parallel_for(A.rows(), [&](int i) {
    Eigen::Map<Eigen::Matrix3d> inverse(inverse_diagonal_.data() + 9 * static_cast<size_t>(i));
    inverse = A.block(A.diagonal[static_cast<size_t>(i)]).inverse();
  });
}

LinearReport ConjugateGradientSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets,
                                            Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "cg";
  const int n = A_->rows();
  const auto precondition = [&] {
    parallel_for(n, [&](int i) {
      const Eigen::Map<const Eigen::Matrix3d> inverse(inverse_diagonal_.data() + 9 * static_cast<size_t>(i));
      z_.segment<3>(3 * i).noalias() = inverse * r_.segment<3>(3 * i);
    });
  };
  x.setZero(b.size());
  r_ = b;
  z_.resize(b.size());
  precondition();
  p_ = z_;
  double rz = dot(r_, z_);
  const long limit = max_iterations_ > 0 ? max_iterations_ : std::max(1000L, 10L * b.size());
  while (!within(r_, targets)) {
    if (report.iterations >= limit) {
      report.reason = "conjugate gradients did not converge";
      return report;
    }
    ++report.iterations;
    A_->multiply(p_, Ap_);
    const double pAp = dot(p_, Ap_);
    if (!(pAp > 0)) {
      report.reason = "the matrix is not positive definite";
      return report;
    }
    const double alpha = rz / pAp;
    parallel_for(n, [&](int i) {
      x.segment<3>(3 * i) += alpha * p_.segment<3>(3 * i);
      r_.segment<3>(3 * i) -= alpha * Ap_.segment<3>(3 * i);
    });
    precondition();
    const double next = dot(r_, z_);
    const double beta = next / rz;
    rz = next;
    parallel_for(n, [&](int i) { p_.segment<3>(3 * i) = z_.segment<3>(3 * i) + beta * p_.segment<3>(3 * i); });
  }
  report.ok = true;
  return report;
}

}  // namespace softreel::sim
