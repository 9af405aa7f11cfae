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
  return parallel_sum(count, Work::kVector, [&](int i) { return a(first + i) * b(first + i); });
}

/// Block rows [first, first + count) of one body, worked on by one thread in one go: an iteration makes three passes
/// over the vectors instead of one for each operation.
struct Chunk {
  int first, count;
  size_t body;
};

std::vector<Chunk> chunks_of(std::span<const BodyRange> bodies, int rows) {
  constexpr int kRows = 512;
  std::vector<Chunk> chunks;
  const auto cut = [&](int first, int count, size_t body) {
    for (int i = 0; i < count; i += kRows) chunks.push_back({first + i, std::min(kRows, count - i), body});
  };
  for (size_t b = 0; b < bodies.size(); ++b) cut(bodies[b].first, bodies[b].count, b);
  if (bodies.empty()) cut(0, rows, 0);
  return chunks;
}

/// Calls body(c, chunk); in parallel if there is enough to do.
template <class Body>
void for_chunks(const std::vector<Chunk>& chunks, int rows, const Body& body) {
  const auto one = [&](int c) { body(static_cast<size_t>(c), chunks[static_cast<size_t>(c)]); };
  const int n = static_cast<int>(chunks.size());
  if (rows >= static_cast<int>(Work::kRow) && threads() > 1) return parallel_tasks(n, one);
  for (int c = 0; c < n; ++c) one(c);
}

}  // namespace

void ConjugateGradientSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  inverse_diagonal_.resize(9 * static_cast<size_t>(A.rows()));
  parallel_for(A.rows(), Work::kRow, [&](int i) {
    Eigen::Map<Eigen::Matrix3d> inverse(inverse_diagonal_.data() + 9 * static_cast<size_t>(i));
    inverse = A.block(A.diagonal[static_cast<size_t>(i)]).inverse();
  });
}

LinearReport ConjugateGradientSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets,
                                            Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "cg";
  const int n = A_->rows();
  const std::vector<Chunk> chunks = chunks_of(targets.bodies, n);
  std::vector<double> rz_of(chunks.size()), rr_of(chunks.size()), pAp_of(chunks.size());
  std::vector<double> rr(std::max<size_t>(1, targets.bodies.size()));
  x.setZero(b.size());
  r_ = b;
  z_.resize(b.size());
  Ap_.resize(b.size());

  // z = P^-1 r, r . z and r . r of a chunk
  const auto precondition = [&](size_t c, const Chunk& chunk) {
    double rz = 0, squared = 0;
    for (int i = chunk.first; i < chunk.first + chunk.count; ++i) {
      const Eigen::Map<const Eigen::Matrix3d> inverse(inverse_diagonal_.data() + 9 * static_cast<size_t>(i));
      const Eigen::Vector3d r = r_.segment<3>(3 * i);
      const Eigen::Vector3d z = inverse * r;
      z_.segment<3>(3 * i) = z;
      rz += r.dot(z);
      squared += r.squaredNorm();
    }
    rz_of[c] = rz;
    rr_of[c] = squared;
  };
  const auto sum = [](const std::vector<double>& parts) {
    double total = 0;
    for (double part : parts) total += part;
    return total;
  };
  const auto within = [&] {
    std::fill(rr.begin(), rr.end(), 0.0);
    for (size_t c = 0; c < chunks.size(); ++c) rr[chunks[c].body] += rr_of[c];
    for (size_t body = 0; body < targets.residual.size(); ++body)
      if (!(rr[body] <= targets.residual[body] * targets.residual[body])) return false;
    return true;
  };

  for_chunks(chunks, n, precondition);
  p_ = z_;
  double rz = sum(rz_of);
  const long limit = max_iterations_ > 0 ? max_iterations_ : std::max(1000L, 10L * b.size());
  while (!within()) {
    if (report.iterations >= limit) {
      report.reason = "conjugate gradients did not converge";
      return report;
    }
    ++report.iterations;
    for_chunks(chunks, n, [&](size_t c, const Chunk& chunk) {
      A_->multiply_rows(chunk.first, chunk.count, p_, Ap_);
      pAp_of[c] = p_.segment(3 * chunk.first, 3 * chunk.count).dot(Ap_.segment(3 * chunk.first, 3 * chunk.count));
    });
    const double pAp = sum(pAp_of);
    if (!(pAp > 0)) {
      report.reason = "the matrix is not positive definite";
      report.indefinite = true;
      return report;
    }
    const double alpha = rz / pAp;
    for_chunks(chunks, n, [&](size_t c, const Chunk& chunk) {
      const int first = 3 * chunk.first, count = 3 * chunk.count;
      x.segment(first, count) += alpha * p_.segment(first, count);
      r_.segment(first, count) -= alpha * Ap_.segment(first, count);
      precondition(c, chunk);
    });
    const double next = sum(rz_of);
    const double beta = next / rz;
    rz = next;
    for_chunks(chunks, n, [&](size_t, const Chunk& chunk) {
      const int first = 3 * chunk.first, count = 3 * chunk.count;
      p_.segment(first, count) = z_.segment(first, count) + beta * p_.segment(first, count);
    });
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
  std::array<Eigen::VectorXd, 6> Z, AZ;  // the modes of all bodies in one vector each
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
  for (auto& product : AZ) product.resize(b.size());
  for (const BodyRange& body : targets.bodies) {
    const int first = 3 * body.first, count = 3 * body.count;
    // Bodies may be tied to each other: the modes of this one alone, and the residual that the others have left.
    parallel_for(body.count, Work::kRow, [&](int k) {
      const int i = body.first + k;
      Eigen::Matrix<double, 3, 6> own = Eigen::Matrix<double, 3, 6>::Zero();
      Eigen::Vector3d r = b.segment<3>(3 * i);
      for (int at = A_->row_start[static_cast<size_t>(i)]; at < A_->row_start[static_cast<size_t>(i) + 1]; ++at) {
        const int j = A_->column[static_cast<size_t>(at)];
        r -= A_->block(at) * x.segment<3>(3 * j);
        if (j < body.first || j >= body.first + body.count) continue;
        for (size_t m = 0; m < 6; ++m) own.col(static_cast<Eigen::Index>(m)) += A_->block(at) * Z[m].segment<3>(3 * j);
      }
      r_.segment<3>(3 * i) = r;
      for (size_t m = 0; m < 6; ++m) AZ[m].segment<3>(3 * i) = own.col(static_cast<Eigen::Index>(m));
    });
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
