#include "sim/convergence_watch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "sim/linear_input.h"

namespace softreel::sim {

std::string figures(double value, int digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

ConvergenceWatch::ConvergenceWatch(std::string method, long max_iterations)
    : method_(std::move(method)), limit_(max_iterations > 0 ? max_iterations : 10000) {}

void ConvergenceWatch::record(double norm) {
  if (recorded_ == 0) first_ = norm;
  norms_[static_cast<size_t>(recorded_++ % (kWindow + 1))] = norm;
}

double ConvergenceWatch::rate() const {
  const long span = std::min(kWindow, iterations());
  if (span <= 0) return 0;
  return std::pow(at(recorded_ - 1) / at(recorded_ - 1 - span), 1.0 / static_cast<double>(span));
}

double ConvergenceWatch::factor(long back) const {
  return iterations() > back ? at(recorded_ - 1 - back) / at(recorded_ - 2 - back) : 0;
}

double ConvergenceWatch::growth() const { return at(recorded_ - 1) / first_; }

std::string ConvergenceWatch::verdict(double excess) const {
  if (!std::isfinite(at(recorded_ - 1)) || std::isnan(excess)) return method_ + " ran away: its residual is not finite";
  if (iterations() >= limit_)
    return method_ + " did not converge in " + std::to_string(limit_) + " iterations" + forecast(excess);
  if (iterations() < 4 * kWindow || rate() < 0.99) return {};
  const double left = rate() < 1 ? std::log(excess) / -std::log(rate()) : std::numeric_limits<double>::infinity();
  if (left < 10 * static_cast<double>(limit_)) return {};
  return method_ + " is too slow here" + forecast(excess);
}

std::string ConvergenceWatch::forecast(double excess) const {
  if (!(rate() < 1)) return ": its residual does not shrink; take cg or cholesky";
  return ": its residual shrinks by a factor of " + figures(rate(), rate() > 0.999 ? 6 : 4) + " in each, " +
         figures(std::log(excess) / -std::log(rate()), 2) + " more would do; take cg or cholesky";
}

ResidualCheck::Verdict ResidualCheck::operator()(const BlockMatrix& A, const Eigen::VectorXd& b,
                                                 const LinearTargets& targets, const Eigen::VectorXd& x,
                                                 Eigen::VectorXd& r) {
  residual_of(A, b, x, r);
  const double now = excess(targets, r);
  if (now <= 1) return Verdict::kSolved;
  if (!(now < 0.5 * last_)) return Verdict::kAtRounding;
  last_ = now;
  return Verdict::kGoOn;
}

}  // namespace softreel::sim
