#pragma once
// Ties between bodies: a vertex of one, bound to a point on the surface of another.
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// A vertex and the point that it is bound to.
struct Tie {
  int vertex = 0;
  Triangle corners = {0, 0, 0};    ///< vertices of the state; all the same: bound to that vertex
  Vec3 weights = Vec3(1, 0, 0);    ///< barycentric, >= 0, sum 1
  double stiffness = 0;            ///< [N/m] > 0
  double length = 0;               ///< at rest [m] >= 0; 0: the two points are drawn together
  Vec3 to_corners = Vec3::Zero();  ///< rest distances to the three corners [m], if length > 0
  bool to_surface() const { return corners[0] != corners[1]; }
};

/// Elastic energy of ties. With r = x_i - sum w_j x_j:
///   length 0: E = k/2 |r|^2, whose Hessian is constant;
///   else:     E = k/2 (|r| - L)^2 + k/3 sum_j (|x_i - x_j| - L_j)^2: a rod across the gap, and rods to the corners of
///   the
///             triangle, since the first alone would let the surfaces slide past each other.
/// An offset in world coordinates would do without the rods, but would not turn with the bodies. Both energies are
/// functions of distances alone: forces sum to zero, and so do torques. One term for each kind of tie that there is.
std::vector<std::unique_ptr<EnergyTerm>> make_ties(const std::vector<Tie>& ties);

/// D = c/2 |dr/dt|^2 for ties of length 0, c/2 (r/|r| . dr/dt)^2 (direction at the predicted positions) for others;
/// c [N s/m] >= 0.
std::vector<std::unique_ptr<EnergyTerm>> make_tie_damping(const std::vector<Tie>& ties, double damping);

/// How ties are made between two bodies.
struct AttachSettings {
  double near = 0;       ///< vertices nearer than this to the other surface are tied [m] > 0
  bool snap = false;     ///< draw the points together, whatever their distance
  double stiffness = 0;  ///< of one tie [N/m]; 0: from the stiffness of what is tied
};

/// A body as ties see it: its vertices in the state (from `first`), placed, and its surface (vertices counted from 0);
/// without triangles, points are bound to points.
struct TiedBody {
  int first = 0;
  const std::vector<Vec3>* rest = nullptr;
  std::vector<Triangle> surface;
};

/// Binds `vertices` of `a` (from 0) that lie within `near` of `b` to the nearest points of b. Ties shorter than 1e-3 of
/// the longest side of the triangle that they end on are taken for touching: length 0 (bound to a point: 1e-6 of the
/// extent of b). `scale`: stiffness_scale of the state without ties, for the default: ten times that of the softer end,
/// so that a tie gives a tenth of what that body gives around it, and no more is asked of the solver than that. An end
/// without stiffness (a free point) does not count; if neither has any, throws std::invalid_argument.
std::vector<Tie> find_ties(const TiedBody& a, std::span<const int> vertices, const TiedBody& b,
                           const AttachSettings& settings, const Eigen::VectorXd& scale);

}  // namespace softreel::sim
