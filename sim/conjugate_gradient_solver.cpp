#include "sim/conjugate_gradient_solver.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "sim/linear_input.h"
#include "sim/parallel.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {
namespace {

// Below so many rows a matrix stays in the cache, and its values need no second copy.
constexpr int kFewRows = 600;
// Targets below this part of b are better reached in double precision from the start.
constexpr double kSingleTarget = 1e-5;
// A matrix of a condition beyond 1e7 is another one in single precision, and hard to get to the end of: after so many
// iterations double precision goes on.
constexpr long kSingleIterations = 600;
constexpr double kRefinementPays = 0.1;

using Chunk = ConjugateGradientSolver::Chunk;

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
  single_.clear();
  preconditioner_.set(A);
}

/// r . r of every chunk.
void ConjugateGradientSolver::measure() {
  for_chunks(chunks_, A_->rows(), [&](size_t c, const Chunk& chunk) {
    rr_[c] = r_.segment(3 * chunk.first, 3 * chunk.count).squaredNorm();
  });
}

/// The residual of every body within its target?
bool ConjugateGradientSolver::within(const LinearTargets& targets, double size) {
  norms_.assign(std::max<size_t>(1, targets.bodies.size()), 0.0);
  for (size_t c = 0; c < chunks_.size(); ++c) norms_[chunks_[c].body] += rr_[c];
  for (size_t body = 0; body < targets.residual.size(); ++body)
    if (!(size * std::sqrt(norms_[body]) <= targets.residual[body])) return false;
  return true;
}

bool ConjugateGradientSolver::single_precision_serves(const LinearTargets& targets) {
  if (A_->rows() < kFewRows || targets.residual.empty() || !preconditioner_->diagonal_blocks()) return false;
  for (size_t body = 0; body < targets.residual.size(); ++body)
    if (!(targets.residual[body] >= kSingleTarget * std::sqrt(norms_[body]))) return false;
  return true;
}

void ConjugateGradientSolver::make_single() {
  single_.set(*A_);
  const double* blocks = preconditioner_->diagonal_blocks();
  float_.blocks.assign(blocks, blocks + 9 * static_cast<size_t>(A_->rows()));
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
  chunks_ = chunks_of(targets.bodies, A_->rows());
  for (auto* parts : {&rz_, &rr_, &pAp_}) parts->resize(chunks_.size());
  x.setZero(b.size());
  r_ = b;
  measure();
  bool done = within(targets), single = single_precision_serves(targets);
  if (single && single_.empty()) make_single();
  const long limit = max_iterations_ > 0 ? max_iterations_ : std::max(1000L, 10L * b.size());
  for (double last = norm(r_); !done && single;) {
    const double size = norm(r_);  // brought to 1: single precision ends at 1e-38
    float_.r = (r_ / size).cast<float>();
    const End end = iterate(targets, size, std::min(limit, report.iterations + kSingleIterations), float_, report);
    x_next_ = x + size * float_.dx.cast<double>();
    residual_of(*A_, b, x_next_, r_next_);
    const double now = norm(r_next_);
    if (now < last) {
      x.swap(x_next_);
      r_.swap(r_next_);
    }
    measure();
    done = within(targets);
    // What rounding has left is solved for once more, as long as that pays.
    single = end == End::kDone && now < kRefinementPays * last;
    last = now;
  }
  if (!done) {
    double_.r = r_;
    const End end = iterate(targets, 1, limit, double_, report);
    if (end == End::kTooSlow) {
      report.reason = "conjugate gradients did not converge in " + std::to_string(report.iterations) + " iterations";
      return report;
    }
    if (end == End::kIndefinite) {
      refuse(report, kNotPositiveDefinite, *A_, b);
      return report;
    }
    x += double_.dx;
  }
  report.ok = true;
  correct_rigid_modes(*A_, b, targets, x);
  return report;
}

/// w.dx := the correction for w.r, until the recursion's residual is within the targets; w is in units of `size`.
template <class Scalar>
ConjugateGradientSolver::End ConjugateGradientSolver::iterate(const LinearTargets& targets, double size, long limit,
                                                              Vectors<Scalar>& w, LinearReport& report) {
  using Block = Eigen::Matrix<Scalar, 3, 3>;
  constexpr bool kSingle = std::is_same_v<Scalar, float>;
  const int n = A_->rows();
  const Scalar* blocks;
  if constexpr (kSingle)
    blocks = w.blocks.data();
  else
    blocks = preconditioner_->diagonal_blocks();
  w.dx.setZero(w.r.size());
  w.z.resize(w.r.size());
  w.Ap.resize(w.r.size());
  // z = P^-1 r (by blocks), r . z and r . r of a chunk
  const auto precondition = [&](size_t c, const Chunk& chunk) {
    double rz = 0, squared = 0;
    for (int i = chunk.first; i < chunk.first + chunk.count; ++i) {
      const Eigen::Map<const Block> inverse(blocks + 9 * static_cast<size_t>(i));
      const Eigen::Matrix<Scalar, 3, 1> r = w.r.template segment<3>(3 * i);
      const Eigen::Matrix<Scalar, 3, 1> z = inverse * r;
      w.z.template segment<3>(3 * i) = z;
      rz += static_cast<double>(r.dot(z));
      squared += static_cast<double>(r.squaredNorm());
    }
    rz_[c] = rz;
    rr_[c] = squared;
  };
  // The same for a preconditioner that is more than blocks: a pass of its own.
  const auto precondition_all = [&] {
    if constexpr (!kSingle) {
      preconditioner_->apply(w.r, w.z);
      for_chunks(chunks_, n, [&](size_t c, const Chunk& chunk) {
        const auto r = w.r.segment(3 * chunk.first, 3 * chunk.count);
        rz_[c] = r.dot(w.z.segment(3 * chunk.first, 3 * chunk.count));
        rr_[c] = r.squaredNorm();
      });
    }
  };
  const auto sum = [](const std::vector<double>& parts) {
    double total = 0;
    for (double part : parts) total += part;
    return total;
  };

  if (blocks)
    for_chunks(chunks_, n, precondition);
  else
    precondition_all();
  w.p = w.z;
  double rz = sum(rz_);
  while (!within(targets, size)) {
    if (report.iterations >= limit) return End::kTooSlow;
    ++report.iterations;
    for_chunks(chunks_, n, [&](size_t c, const Chunk& chunk) {
      if constexpr (kSingle)
        single_.multiply_rows(chunk.first, chunk.count, w.p, w.Ap);
      else
        A_->multiply_rows(chunk.first, chunk.count, w.p, w.Ap);
      const auto p = w.p.segment(3 * chunk.first, 3 * chunk.count);
      pAp_[c] = p.template cast<double>().dot(w.Ap.segment(3 * chunk.first, 3 * chunk.count).template cast<double>());
    });
    const double pAp = sum(pAp_);
    if (!(pAp > 0) || !(rz > 0)) return End::kIndefinite;
    const auto alpha = static_cast<Scalar>(rz / pAp);
    for_chunks(chunks_, n, [&](size_t c, const Chunk& chunk) {
      const int first = 3 * chunk.first, count = 3 * chunk.count;
      w.dx.segment(first, count) += alpha * w.p.segment(first, count);
      w.r.segment(first, count) -= alpha * w.Ap.segment(first, count);
      if (blocks) precondition(c, chunk);
    });
    if (!blocks) precondition_all();
    const double next = sum(rz_);
    const auto beta = static_cast<Scalar>(next / rz);
    rz = next;
    for_chunks(chunks_, n, [&](size_t, const Chunk& chunk) {
      const int first = 3 * chunk.first, count = 3 * chunk.count;
      w.p.segment(first, count) = w.z.segment(first, count) + beta * w.p.segment(first, count);
    });
  }
  return End::kDone;
}

std::size_t ConjugateGradientSolver::bytes() const {
  return preconditioner_->bytes() + single_.bytes() + double_.bytes() + float_.bytes();
}

}  // namespace softreel::sim
