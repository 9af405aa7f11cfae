#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
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
  if (targets.positions) correct_rigid_modes(b, targets, x);
  return report;
}

/// x += Z (Z^T A Z)^-1 Z^T (b - A x) body by body, Z its three translations and three turns: the best correction among
/// rigid motions in the norm of the error's energy, so it cannot make x worse.
void ConjugateGradientSolver::correct_rigid_modes(const Eigen::VectorXd& b, const LinearTargets& targets,
                                                  Eigen::VectorXd& x) {
  const Eigen::VectorXd& y = *targets.positions;
  std::array<Eigen::VectorXd, 6> Z, AZ;  // the modes of all bodies at once: they meet in no block of A
  for (auto& mode : Z) mode.setZero(b.size());
  for (const BodyRange& body : targets.bodies) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int i = body.first; i < body.first + body.count; ++i) centre += y.segment<3>(3 * i);
    centre /= body.count;
    for (int i = body.first; i < body.first + body.count; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
        Z[static_cast<size_t>(axis)].segment<3>(3 * i) = e;
        Z[static_cast<size_t>(axis) + 3].segment<3>(3 * i) = e.cross(y.segment<3>(3 * i) - centre);
      }
  }
  if (targets.held)
    for (auto& mode : Z)
      for (size_t i = 0; i < targets.held->size(); ++i)
        if ((*targets.held)[i]) mode(static_cast<Eigen::Index>(i)) = 0;
  for (size_t m = 0; m < 6; ++m) A_->multiply(Z[m], AZ[m]);
  A_->multiply(x, Ap_);
  r_ = b - Ap_;
  for (const BodyRange& body : targets.bodies) {
    const int first = 3 * body.first, count = 3 * body.count;
    Eigen::Matrix<double, 6, 6> gram;
    Eigen::Matrix<double, 6, 1> right;
    for (size_t m = 0; m < 6; ++m) {
      const auto row = static_cast<Eigen::Index>(m);
      right(row) = dot(Z[m], r_, first, count);
      for (size_t k = 0; k < 6; ++k) gram(row, static_cast<Eigen::Index>(k)) = dot(Z[m], AZ[k], first, count);
    }
    // A body of one or two points has fewer modes: the pivoted factorization leaves out what is dependent.
    const Eigen::Matrix<double, 6, 1> step = gram.completeOrthogonalDecomposition().solve(right);
    if (!step.allFinite()) continue;
    for (size_t m = 0; m < 6; ++m)
      x.segment(first, count) += step(static_cast<Eigen::Index>(m)) * Z[m].segment(first, count);
  }
}

}  // namespace softreel::sim
