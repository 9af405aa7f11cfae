#include "sim/gmres_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/convergence_watch.h"
#include "sim/linear_input.h"
#include "sim/parallel.h"
#include "sim/rigid_modes.h"

namespace softreel::sim {

GmresSolver::GmresSolver(const LinearSettings& settings)
    : preconditioner_(settings.preconditioner), restart_(settings.restart), max_iterations_(settings.max_iterations) {}

void GmresSolver::factorize(const BlockMatrix& A) {
  A_ = &A;
  preconditioner_.set(A);
}

LinearReport GmresSolver::solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "gmres";
  report.reason = preconditioner_.prepare(targets);
  if (!report.reason.empty()) {
    refuse(report, report.reason, *A_, b);
    return report;
  }
  x.setZero(b.size());
  r_ = b;
  ConvergenceWatch watch("gmres", max_iterations_);
  const double start = norm(r_);
  double length = start;
  watch.record(length);
  double tightest = std::numeric_limits<double>::infinity(), sum = 0;
  for (double target : targets.residual) {
    tightest = std::min(tightest, target);
    sum += target * target;
  }
  double goal = std::sqrt(sum);  // no larger norm can do for all bodies
  for (double left = excess(targets, r_); !(left <= 1); left = excess(targets, r_)) {
    report.reason = watch.verdict(left);
    const int steps = report.reason.empty() ? cycle(goal, x) : 0;
    if (report.reason.empty() && steps == 0) report.reason = kSingular;
    if (!report.reason.empty()) {
      refuse(report, report.reason, *A_, b);
      return report;
    }
    residual_of(*A_, b, x, r_);
    const double now = norm(r_);
    // The watch counts single iterations; within a cycle each gets its share.
    for (int k = 1; k <= steps; ++k) watch.record(length * std::pow(now / length, double(k) / steps));
    report.iterations = watch.iterations();
    report.rate = watch.rate();
    // A full cycle that gained nothing in all digits of the residual will gain nothing the next time either.
    if (!(now < length * (1 - 1e-6)) && !(excess(targets, r_) <= 1)) {
      report.reason = now <= 1e3 * std::numeric_limits<double>::epsilon() * start
                          ? kAtRounding
                          : "gmres stagnates: a cycle of " + std::to_string(steps) +
                                " iterations does not make the residual smaller; take a longer restart or lu";
      return report;
    }
    length = now;
    // All below the goal together, but a body above its own: that much lower.
    if (now <= goal) goal = std::max(0.9 * now / std::max(1.0, excess(targets, r_)), std::min(goal, tightest));
  }
  report.ok = true;
  report.reason.clear();
  correct_rigid_modes(*A_, b, targets, x);
  return report;
}

int GmresSolver::cycle(double goal, Eigen::VectorXd& x) {
  const int n = static_cast<int>(r_.size());
  const double length = norm(r_);
  R_.setZero(restart_ + 1, restart_);
  g_.setZero(restart_ + 1);
  cosine_.resize(restart_);
  sine_.resize(restart_);
  g_(0) = length;
  V_.resize(static_cast<size_t>(restart_) + 1);
  V_[0] = r_ / length;
  int m = 0;
  while (m < restart_) {
    const auto& v = V_[static_cast<size_t>(m)];
    preconditioner_->apply(v, z_);
    A_->multiply(z_, w_);
    for (int i = 0; i <= m; ++i) {  // modified Gram-Schmidt
      const Eigen::VectorXd& basis = V_[static_cast<size_t>(i)];
      const double h = dot(basis, w_);
      R_(i, m) = h;
      parallel_for(n, Work::kVector, [&](int k) { w_(k) -= h * basis(k); });
    }
    const double h = norm(w_);
    for (int i = 0; i < m; ++i) {
      const double a = R_(i, m), c = R_(i + 1, m);
      R_(i, m) = cosine_(i) * a + sine_(i) * c;
      R_(i + 1, m) = cosine_(i) * c - sine_(i) * a;
    }
    const double diagonal = std::hypot(R_(m, m), h);
    if (!(diagonal > 0) || !std::isfinite(diagonal)) break;  // A P^-1 v is nothing, or nothing that can be used
    cosine_(m) = R_(m, m) / diagonal;
    sine_(m) = h / diagonal;
    R_(m, m) = diagonal;
    g_(m + 1) = -sine_(m) * g_(m);
    g_(m) *= cosine_(m);
    ++m;
    if (std::abs(g_(m)) <= goal || h == 0) break;
    V_[static_cast<size_t>(m)] = w_ / h;
  }
  if (m == 0) return 0;
  for (int i = m - 1; i >= 0; --i) {
    for (int k = i + 1; k < m; ++k) g_(i) -= R_(i, k) * g_(k);
    g_(i) /= R_(i, i);
  }
  w_.setZero(n);
  parallel_for(n, Work::kVector, [&](int k) {
    double u = 0;
    for (int i = 0; i < m; ++i) u += g_(i) * V_[static_cast<size_t>(i)](k);
    w_(k) = u;
  });
  preconditioner_->apply(w_, z_);
  parallel_for(n, Work::kVector, [&](int k) { x(k) += z_(k); });
  return m;
}

std::size_t GmresSolver::bytes() const {
  Eigen::Index doubles = R_.size() + r_.size() + z_.size() + w_.size() + cosine_.size() + sine_.size() + g_.size();
  for (const Eigen::VectorXd& v : V_) doubles += v.size();
  return preconditioner_->bytes() + sizeof(double) * static_cast<size_t>(doubles);
}

}  // namespace softreel::sim
