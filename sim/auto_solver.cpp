#include "sim/auto_solver.h"

#include <algorithm>
#include <stdexcept>

namespace softreel::sim {
namespace {

// Work in units of one nanosecond on the machine they were measured on (two cores of 2.4 GHz): only their ratio counts.
constexpr double kPerFlop = 0.027;        // supernodal factorization, one thread
constexpr double kPerFactorNonzero = 16;  // its memory traffic, the copy of the values, the triangular solves
constexpr double kPerBlock = 1.2;         // product with one 3x3 block in single precision
constexpr double kPerRow = 10;            // vector work of an iteration, per block row

// Below this size a direct solve costs less than finding out.
constexpr int kSmall = 600;
constexpr double kWeightOfNew = 0.125;  // of a solve, in the mean number of iterations
// The first time that iterations cost too much, so many solves are direct before they are tried again; every further
// time in a row twice as many and these, up to the longest.
constexpr long kFirstPause = 2, kLongestPause = 64;
// A matrix that stays is factorized if that costs no more than so many solves by iteration: a second of a clip, most
// often.
constexpr double kSolvesOfOneMatrix = 60;
constexpr long kForever = 1L << 50;  // a double holds it exactly

}  // namespace

double AutoSolver::iteration_work() const {
  return kPerBlock * static_cast<double>(A_->column.size()) + kPerRow * A_->rows();
}

double AutoSolver::cholesky_work() {
  // A pattern that changes a little with every contact is not counted anew: that would cost more than it tells.
  if (work_ == 0) {
    analyse_factor();
    work_ = kPerFlop * cholesky_.factor_flops() + kPerFactorNonzero * cholesky_.factor_nonzeros();
  }
  return work_;
}

void AutoSolver::analyse(const BlockMatrix& A) {
  A_ = &A;
  current_ = factored_ = conditioned_ = false;
}

void AutoSolver::analyse_factor() {
  if (!current_) cholesky_.analyse(*A_);
  current_ = true;
}

void AutoSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  factored_ = conditioned_ = false;
}

/// Iterations that cost as much as a factorization.
long AutoSolver::affordable() { return std::max(10L, static_cast<long>(cholesky_work() / iteration_work())); }

LinearReport AutoSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  if (A_->rows() > kSmall && (!direct_ || ++direct_solves_ > pause_)) {
    LinearReport report = iterate(b, targets, x);
    // A direction without curvature is proof: a factorization would find no more than that.
    if (report.ok || report.indefinite) return report;
    LinearReport direct = factor(b, targets, x);
    direct.iterations = report.iterations;
    return direct;
  }
  return factor(b, targets, x);
}

/// Iterations up to what the factorization would cost, which is found out once they look expensive.
LinearReport AutoSolver::iterate(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  constexpr long kCheap = 60;
  if (!conditioned_) cg_.factorize(*A_);
  conditioned_ = true;
  cg_.set_max_iterations(work_ > 0 ? affordable() : kCheap);
  LinearReport report = cg_.solve(b, targets, x);
  long spent = 0;
  if (!report.ok && !report.indefinite && work_ == 0 && affordable() > kCheap) {
    spent = report.iterations;
    cg_.set_max_iterations(affordable());
    report = cg_.solve(b, targets, x);
  }
  if (!report.indefinite) judge(report);
  report.iterations += spent;
  return report;
}

/// Direct solves from now on, if iterations have cost more on average.
void AutoSolver::judge(const LinearReport& report) {
  // One that was given up would have taken longer still.
  const double iterations = static_cast<double>(report.iterations) * (report.ok ? 1 : 2);
  const bool afresh = direct_ || mean_ == 0;
  mean_ = afresh ? iterations : mean_ + kWeightOfNew * (iterations - mean_);
  direct_ = !report.ok && mean_ > static_cast<double>(affordable());
  direct_solves_ = 0;
  if (same_matrix_ && kSolvesOfOneMatrix * mean_ > static_cast<double>(affordable())) {
    direct_ = true;
    pause_ = kForever;
    return;
  }
  if (direct_)
    pause_ = std::min(2 * pause_ + kFirstPause, kLongestPause);
  else
    pause_ = 0;
}

LinearReport AutoSolver::factor(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  analyse_factor();
  if (!factored_) cholesky_.factorize(*A_);
  factored_ = true;
  return cholesky_.solve(b, targets, x);
}

std::size_t AutoSolver::bytes() const { return cg_.bytes() + (cholesky_.analysed() ? cholesky_.bytes() : 0); }

std::vector<double> AutoSolver::memory() const {
  return {direct_ ? 1.0 : 0.0, static_cast<double>(direct_solves_), static_cast<double>(pause_), mean_, work_};
}

void AutoSolver::restore(std::span<const double> saved) {
  if (saved.size() != 5) throw std::invalid_argument("memory of another linear solver");
  direct_ = saved[0] != 0;
  direct_solves_ = static_cast<long>(saved[1]);
  pause_ = static_cast<long>(saved[2]);
  mean_ = saved[3];
  work_ = saved[4];
}

}  // namespace softreel::sim
