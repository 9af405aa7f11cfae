#pragma once
// Tells early that an iteration will not get where it should.
#include <array>
#include <limits>
#include <string>

#include "sim/linear_solver.h"

namespace softreel::sim {

/// Fed with the norm of the residual after every iteration. What it measures is the factor by which the residual
/// changes, in the end the spectral radius of the iteration: |r_k| ~ rho^k.
class ConvergenceWatch {
 public:
  /// `method`: what the reasons call it; `max_iterations` of the settings (0: 10,000).
  ConvergenceWatch(std::string method, long max_iterations);

  /// The residual's norm at the start, then after each iteration.
  void record(double norm);

  long iterations() const { return recorded_ - 1; }
  long limit() const { return limit_; }
  double rate() const;  ///< mean factor per iteration over the last (at most) 32
  /// Factor of the last iteration, or of so many before it; 0 where there was none.
  double factor(long back = 0) const;
  double growth() const;  ///< norm over that at the start

  /// Why to stop before the residual has shrunk by a further factor of `excess` (> 1), or nothing: not finite; at the
  /// limit; or the rate is such that ten times the limit would not do.
  std::string verdict(double excess) const;

 private:
  static constexpr long kWindow = 32;

  double at(long k) const { return norms_[static_cast<size_t>(k % (kWindow + 1))]; }
  std::string forecast(double excess) const;

  std::string method_;
  long limit_;
  long recorded_ = 0;
  double first_ = 0;
  std::array<double, kWindow + 1> norms_{};
};

/// Whether the residual that an iteration carries along is the one that x has. Rounding drives them apart; then the
/// iteration goes on from the true one, as long as that helps.
class ResidualCheck {
 public:
  enum class Verdict { kSolved, kGoOn, kAtRounding };
  /// r := b - A x.
  Verdict operator()(const BlockMatrix& A, const Eigen::VectorXd& b, const LinearTargets& targets,
                     const Eigen::VectorXd& x, Eigen::VectorXd& r);

 private:
  double last_ = std::numeric_limits<double>::infinity();
};

inline constexpr const char* kAtRounding = "the tolerance is below what rounding leaves of the residual";

/// A number for a message.
std::string figures(double value, int digits);

}  // namespace softreel::sim
