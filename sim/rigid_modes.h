#pragma once
// The six rigid motions of every body: what stiffness does not see, and iterations on its residual find last.
#include <array>

#include "sim/linear_solver.h"

namespace softreel::sim {

/// Three translations and three turns about the bodies' centres, all bodies in one vector (3n) each; zero where held.
/// `targets.positions` must be there.
std::array<Eigen::VectorXd, 6> rigid_modes(const LinearTargets& targets);

/// The residual of a stiff body is all strain: stopped at a thousandth of it, the rigid motion, whose forces are small,
/// could still be wrong altogether. So an iterative solve ends with
/// x += Z (Z^T A Z)^-1 Z^T (b - A x) body by body: the best correction among rigid motions in the norm of the error's
/// energy, so it cannot make x worse. Their part of the error is gone, momentum is kept as a direct solver keeps it.
/// Does nothing without `targets.positions`.
void correct_rigid_modes(const BlockMatrix& A, const Eigen::VectorXd& b, const LinearTargets& targets,
                         Eigen::VectorXd& x);

}  // namespace softreel::sim
