#include "sim/conjugate_gradient_solver.h"

#include <algorithm>
#include <cmath>

#include "sim/linear_input.h"
#include "sim/parallel.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {
namespace {

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

ConjugateGradientSolver::ConjugateGradientSolver(const LinearSettings& settings)
    : preconditioner_(settings.preconditioner), max_iterations_(settings.max_iterations) {}

void ConjugateGradientSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  preconditioner_.set(A);
}

LinearReport ConjugateGradientSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets,
                                            Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "cg";
  report.reason = preconditioner_.prepare(targets);
  if (!report.reason.empty()) {
    refuse(report, report.reason, *A_, b);
    return report;
  }
  const int n = A_->rows();
  const double* blocks = preconditioner_->diagonal_blocks();
  const std::vector<Chunk> chunks = chunks_of(targets.bodies, n);
  std::vector<double> rz_of(chunks.size()), rr_of(chunks.size()), pAp_of(chunks.size());
  std::vector<double> rr(std::max<size_t>(1, targets.bodies.size()));
  x.setZero(b.size());
  r_ = b;
  z_.resize(b.size());
  Ap_.resize(b.size());

  // z = P^-1 r (by blocks), r . z and r . r of a chunk
  const auto precondition = [&](size_t c, const Chunk& chunk) {
    double rz = 0, squared = 0;
    for (int i = chunk.first; i < chunk.first + chunk.count; ++i) {
      const Eigen::Map<const Eigen::Matrix3d> inverse(blocks + 9 * static_cast<size_t>(i));
      const Eigen::Vector3d r = r_.segment<3>(3 * i);
      const Eigen::Vector3d z = inverse * r;
      z_.segment<3>(3 * i) = z;
      rz += r.dot(z);
      squared += r.squaredNorm();
    }
    rz_of[c] = rz;
    rr_of[c] = squared;
  };
  // The same for a preconditioner that is more than blocks: a pass of its own.
  const auto precondition_all = [&] {
    preconditioner_->apply(r_, z_);
    for_chunks(chunks, n, [&](size_t c, const Chunk& chunk) {
      const auto r = r_.segment(3 * chunk.first, 3 * chunk.count);
      rz_of[c] = r.dot(z_.segment(3 * chunk.first, 3 * chunk.count));
      rr_of[c] = r.squaredNorm();
    });
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

  if (blocks)
    for_chunks(chunks, n, precondition);
  else
    precondition_all();
  p_ = z_;
  double rz = sum(rz_of);
  const long limit = max_iterations_ > 0 ? max_iterations_ : std::max(1000L, 10L * b.size());
  while (!within()) {
    if (report.iterations >= limit) {
      report.reason = "conjugate gradients did not converge in " + std::to_string(limit) + " iterations";
      return report;
    }
    ++report.iterations;
    for_chunks(chunks, n, [&](size_t c, const Chunk& chunk) {
      A_->multiply_rows(chunk.first, chunk.count, p_, Ap_);
      pAp_of[c] = p_.segment(3 * chunk.first, 3 * chunk.count).dot(Ap_.segment(3 * chunk.first, 3 * chunk.count));
    });
    const double pAp = sum(pAp_of);
    if (!(pAp > 0) || !(rz > 0)) {
      refuse(report, kNotPositiveDefinite, *A_, b);
      return report;
    }
    const double alpha = rz / pAp;
    for_chunks(chunks, n, [&](size_t c, const Chunk& chunk) {
      const int first = 3 * chunk.first, count = 3 * chunk.count;
      x.segment(first, count) += alpha * p_.segment(first, count);
      r_.segment(first, count) -= alpha * Ap_.segment(first, count);
      if (blocks) precondition(c, chunk);
    });
    if (!blocks) precondition_all();
    const double next = sum(rz_of);
    const double beta = next / rz;
    rz = next;
    for_chunks(chunks, n, [&](size_t, const Chunk& chunk) {
      const int first = 3 * chunk.first, count = 3 * chunk.count;
      p_.segment(first, count) = z_.segment(first, count) + beta * p_.segment(first, count);
    });
  }
  report.ok = true;
  correct_rigid_modes(*A_, b, targets, x);
  return report;
}

std::size_t ConjugateGradientSolver::bytes() const {
  return preconditioner_->bytes() +
         sizeof(double) * static_cast<size_t>(r_.size() + z_.size() + p_.size() + Ap_.size());
}

}  // namespace softreel::sim
