#pragma once
// What is said of systems that no solver, or only some, can do.
#include <string>

#include "sim/linear_solver.h"

namespace softreel::sim {

inline constexpr const char* kNotPositiveDefinite = "the matrix is not positive definite";
inline constexpr const char* kSingular = "the matrix is singular to working precision";

/// Says whether A or b holds an infinity or a NaN; empty if neither. Reads the whole matrix: for when something failed.
std::string not_finite(const BlockMatrix& A, const Eigen::VectorXd& b);

/// Sets the reason, and whether it is that A is not positive definite; where A or b is not finite, that is the reason.
void refuse(LinearReport& report, std::string reason, const BlockMatrix& A, const Eigen::VectorXd& b);

/// Norm of (vector)_body / target of that body, of the body where it is largest: solved where <= 1 for the residual.
double excess(const LinearTargets& targets, const Eigen::VectorXd& residual);

/// x . y and |x|, the same bits for any number of threads.
double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y);
double norm(const Eigen::VectorXd& x);

/// r = b - A x.
void residual_of(const BlockMatrix& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x, Eigen::VectorXd& r);

}  // namespace softreel::sim
