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
// The first time that iterations cost too much, so many solves are direct before they are tried again; every further
// time in a row twice as many and these, up to the longest.
constexpr long kFirstPause = 2, kLongestPause = 64;

}  // namespace

double AutoSolver::iteration_work() const {
  return kPerBlock * static_cast<double>(A_->column.size()) + kPerRow * A_->rows();
}

double AutoSolver::cholesky_work() {
  if (!cholesky_.analysed()) cholesky_.analyse(*A_);
  return kPerFlop * cholesky_.factor_flops() + kPerFactorNonzero * cholesky_.factor_nonzeros();
}

void AutoSolver::analyse(const BlockMatrix& A) {
  A_ = &A;
  direct_ = A.rows() <= kSmall;
  if (direct_) cholesky_.analyse(A);
}

void AutoSolver::factorize(const BlockMatrix& A) { A_ = &A; }

LinearReport AutoSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  ++since_choice_;
  const bool small = A_->rows() <= kSmall;
  const bool test = !small && direct_ && since_choice_ > pause_;
  long spent = 0;
  if (!direct_ || test) {
    // Iterations up to what the factorization would cost; its cost is counted once the iterations look expensive.
    long limit = 60;
    const auto affordable = [&] { return std::max(10L, static_cast<long>(cholesky_work() / iteration_work())); };
    if (cholesky_.analysed()) limit = affordable();
    cg_.factorize(*A_);
    cg_.set_max_iterations(limit);
    LinearReport report = cg_.solve(b, targets, x);
    if (!report.ok && !cholesky_.analysed() && affordable() > 2 * limit) {
      spent = report.iterations;
      cg_.set_max_iterations(affordable());
      report = cg_.solve(b, targets, x);
    }
    if (test) since_choice_ = 0;
    if (report.ok) {
      direct_ = false;
      pause_ = 0;
      report.iterations += spent;
      return report;
    }
    spent += report.iterations;
    direct_ = true;
    since_choice_ = 0;
    pause_ = std::min(2 * pause_ + kFirstPause, kLongestPause);
  }
  if (!cholesky_.analysed()) cholesky_.analyse(*A_);
  cholesky_.factorize(*A_);
  LinearReport report = cholesky_.solve(b, targets, x);
  report.iterations = spent;
  return report;
}

std::size_t AutoSolver::bytes() const { return cg_.bytes() + (cholesky_.analysed() ? cholesky_.bytes() : 0); }

std::vector<double> AutoSolver::memory() const {
  return {direct_ ? 1.0 : 0.0, static_cast<double>(since_choice_), static_cast<double>(pause_),
          cholesky_.analysed() ? 1.0 : 0.0};
}

void AutoSolver::restore(std::span<const double> saved) {
  if (saved.size() != 4) throw std::invalid_argument("memory of another linear solver");
  direct_ = saved[0] != 0;
  since_choice_ = static_cast<long>(saved[1]);
  pause_ = static_cast<long>(saved[2]);
  if (saved[3] != 0 && !cholesky_.analysed()) cholesky_.analyse(*A_);
}

}  // namespace softreel::sim
