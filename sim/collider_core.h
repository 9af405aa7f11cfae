#pragma once
// The inside of a collider that no vertex passes: what gets so deep would be pushed out on the other side.
#include <Eigen/Core>
#include <optional>

#include "sim/collider.h"

namespace softreel::sim {

/// A collider, smaller by `depth` on all sides: all points that are deeper than that.
struct ColliderCore {
  ColliderShape shape;
  double depth = 0;  ///< [m]
};

/// 20 contact distances deep, or 0.9 of the deepest point's depth where that is less. Contact that goes by mass and
/// step (collider_contact.h) stops 44,100 d_hat/h there: a vertex of 5300 m/s in a step of 1/60 s at a distance of 2
/// mm. None for a plane, which has no other side, and for a mesh. `distance`: d_hat [m] > 0.
std::optional<ColliderCore> core_of(const ColliderShape& shape, double distance);

/// A lower bound, in [0, 1], of how far a point can go straight from `a` to `b` (in the collider's own frame) before it
/// comes so near to the core that a tenth of the way to it, or of `depth`, is left. 1 for one that is in it already:
/// contact pushes it out, on whichever side that is.
///
/// Conservative advancement (Mirtich 1996, "Impulse-based dynamic simulation", section 2.3): a point at a distance d
/// from the core can go so far without touching it; the way is made of such pieces. Ending early only makes the answer
/// smaller.
double free_share(const ColliderCore& core, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace softreel::sim
