#pragma once
// The penalty of one pair: psi(d) = k/3 (d_hat - (d - offset))^3 of the exact distance d, where that is positive.
#include <Eigen/Core>

#include "sim/contact/closest_points.h"
#include "sim/energy_term.h"

namespace softreel::sim {

struct PairPenalty {
  double stiffness = 0;  ///< k [N/m^2] > 0
  double reach = 0;      ///< d_hat [m] > 0
  double offset = 0;     ///< of both surfaces' half thickness [m] >= 0
  /// Edge pairs only: |u|^2 |v|^2 of the edges at rest [m^4]. Below a thousandth of it, |u x v|^2 fades the penalty
  /// out: the nearest points of parallel edges are not unique, and the energy would have a kink (Li et al. 2020,
  /// "Incremental potential contact", section 4.3).
  double cross_rest = 0;

  /// d_hat - (d - offset) [m]; the pair is active where that is positive.
  double intrusion(double distance) const { return reach + offset - distance; }
  /// Size of the force [N] at an intrusion s > 0: -psi'.
  double force(double s) const { return stiffness * s * s; }
};

/// How much of the penalty counts: 1, or less where two edges are nearly parallel.
double parallel_share(PairKind kind, const FourPoints& x, const PairPenalty& penalty);

/// All for active pairs. `c` = closest_points(kind, x).
double pair_value(PairKind kind, const FourPoints& x, const ClosestPoints& c, const PairPenalty& penalty);  ///< [J]
void pair_gradient(PairKind kind, const FourPoints& x, const ClosestPoints& c, const PairPenalty& penalty,
                   FourPoints& gradient);  ///< [N], written

/// 12 x 12, written. The clamped one in closed form but for an eigenproblem of at most 5 x 5: see the source.
void pair_hessian(PairKind kind, const FourPoints& x, const ClosestPoints& c, const PairPenalty& penalty,
                  Definiteness definiteness, Eigen::Matrix<double, 12, 12>& H);

}  // namespace softreel::sim
