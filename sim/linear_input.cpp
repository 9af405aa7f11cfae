#include "sim/linear_input.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/parallel.h"

namespace softreel::sim {

std::string not_finite(const BlockMatrix& A, const Eigen::VectorXd& b) {
  if (!b.allFinite()) return "the right-hand side is not finite";
  const bool finite = std::all_of(A.values.begin(), A.values.end(), [](double v) { return std::isfinite(v); });
  return finite ? "" : "the matrix is not finite";
}

void refuse(LinearReport& report, std::string reason, const BlockMatrix& A, const Eigen::VectorXd& b) {
  report.ok = false;
  report.reason = not_finite(A, b);
  if (!report.reason.empty()) return;
  report.reason = std::move(reason);
  report.indefinite = report.reason.starts_with(kNotPositiveDefinite) || report.reason == kSingular;
}

double excess(const LinearTargets& targets, const Eigen::VectorXd& residual) {
  double worst = 0;
  for (size_t body = 0; body < targets.residual.size(); ++body) {
    const int first = targets.bodies.empty() ? 0 : 3 * targets.bodies[body].first;
    const int count = targets.bodies.empty() ? static_cast<int>(residual.size()) : 3 * targets.bodies[body].count;
    const double length =
        std::sqrt(parallel_sum(count, Work::kVector, [&](int i) { return residual(first + i) * residual(first + i); }));
    if (std::isnan(length)) return std::numeric_limits<double>::quiet_NaN();
    if (length > 0) worst = std::max(worst, length / targets.residual[body]);  // infinite for a target of 0
  }
  return worst;
}

double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  return parallel_sum(static_cast<int>(x.size()), Work::kVector, [&](int i) { return x(i) * y(i); });
}

double norm(const Eigen::VectorXd& x) { return std::sqrt(dot(x, x)); }

void residual_of(const BlockMatrix& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x, Eigen::VectorXd& r) {
  r.resize(b.size());
  parallel_for(A.rows(), Work::kRow, [&](int i) {
    A.multiply_rows(i, 1, x, r);
    r.segment<3>(3 * i) = b.segment<3>(3 * i) - r.segment<3>(3 * i);
  });
}

}  // namespace softreel::sim
