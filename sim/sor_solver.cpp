#include "sim/sor_solver.h"

#include <cmath>
#include <stdexcept>

#include "sim/linear_input.h"
#include "sim/parallel.h"

namespace softreel::sim {

SorSolver::SorSolver(std::string_view name, double omega, const LinearSettings& settings)
    : StationarySolver(name, settings), name_(name), omega_(omega) {
  if (!(omega > 0 && omega < 2))
    throw std::invalid_argument("sor converges only for omega between 0 and 2; found " + figures(omega, 6));
}

/// Forward substitution with D/omega + L, unknown by unknown.
void SorSolver::solve_splitting(const Eigen::VectorXd& r, Eigen::VectorXd& d) const {
  const BlockMatrix& A = matrix();
  for (int i = 0; i < A.rows(); ++i) {
    const int own = A.diagonal[static_cast<size_t>(i)];
    double s0 = r(3 * i), s1 = r(3 * i + 1), s2 = r(3 * i + 2);
    const double* a = A.values.data() + 9 * static_cast<size_t>(A.row_start[static_cast<size_t>(i)]);
    for (int k = A.row_start[static_cast<size_t>(i)]; k < own; ++k, a += 9) {
      const double* p = d.data() + 3 * static_cast<size_t>(A.column[static_cast<size_t>(k)]);
      s0 -= a[0] * p[0] + a[3] * p[1] + a[6] * p[2];
      s1 -= a[1] * p[0] + a[4] * p[1] + a[7] * p[2];
      s2 -= a[2] * p[0] + a[5] * p[1] + a[8] * p[2];
    }
    double* own_d = d.data() + 3 * static_cast<size_t>(i);
    own_d[0] = omega_ * s0 / a[0];
    own_d[1] = omega_ * (s1 - a[1] * own_d[0]) / a[4];
    own_d[2] = omega_ * (s2 - a[2] * own_d[0] - a[5] * own_d[1]) / a[8];
  }
}

/// N = (1/omega - 1) D - U, U: above the diagonal.
void SorSolver::multiply_rest(const Eigen::VectorXd& d, Eigen::VectorXd& Nd) const {
  const BlockMatrix& A = matrix();
  const double share = 1 / omega_ - 1;
  parallel_for(A.rows(), Work::kRow, [&](int i) {
    const int own = A.diagonal[static_cast<size_t>(i)];
    const double* a = A.values.data() + 9 * static_cast<size_t>(own);
    const double* own_d = d.data() + 3 * static_cast<size_t>(i);
    double s0 = share * a[0] * own_d[0] - a[3] * own_d[1] - a[6] * own_d[2];
    double s1 = share * a[4] * own_d[1] - a[7] * own_d[2];
    double s2 = share * a[8] * own_d[2];
    a += 9;
    for (int k = own + 1; k < A.row_start[static_cast<size_t>(i) + 1]; ++k, a += 9) {
      const double* p = d.data() + 3 * static_cast<size_t>(A.column[static_cast<size_t>(k)]);
      s0 -= a[0] * p[0] + a[3] * p[1] + a[6] * p[2];
      s1 -= a[1] * p[0] + a[4] * p[1] + a[7] * p[2];
      s2 -= a[2] * p[0] + a[5] * p[1] + a[8] * p[2];
    }
    Nd(3 * i) = s0;
    Nd(3 * i + 1) = s1;
    Nd(3 * i + 2) = s2;
  });
}

double SorSolver::watched_norm(const Eigen::VectorXd& r) const { return norm(r); }

/// For positive definite A the error falls in its energy norm with every sweep, so the residual never exceeds
/// sqrt(cond A) times the first. What exceeds it a million times belongs to an A that is not, or whose condition is
/// beyond double precision.
bool SorSolver::diverges(const ConvergenceWatch& watch) const { return watch.growth() > 1e6; }

std::string SorSolver::divergence(double radius) const {
  return std::string(kNotPositiveDefinite) + ": " + std::string(name_) +
         " diverges, the spectral radius of I - P^-1 A is about " + figures(radius, 4);
}

}  // namespace softreel::sim
