#pragma once
// Rigid obstacles given by their signed distance.
#include <Eigen/Core>
#include <variant>

#include "sim/motion.h"

namespace softreel::sim {

struct PlaneShape {};  ///< half space y <= 0 of the collider's own frame is solid
struct SphereShape {
  double radius = 1;  ///< [m] > 0
};
struct BoxShape {
  Eigen::Vector3d half = Eigen::Vector3d::Ones();  ///< half extents [m] > 0
};
/// Axis along y; all points within `radius` of the segment from -half to half.
struct CapsuleShape {
  double radius = 1;  ///< [m] > 0
  double half = 1;    ///< half length of the axis [m] >= 0
};
/// A mesh, which is among the contact surfaces (contact/contact_surfaces.h) and has no distance here: infinitely far.
struct SurfaceShape {};
using ColliderShape = std::variant<PlaneShape, SphereShape, BoxShape, CapsuleShape, SurfaceShape>;

struct SignedDistance {
  double distance = 0;     ///< [m], negative inside
  Eigen::Vector3d normal;  ///< unit, away from the solid
};

/// Distance from `p`, both in the collider's own frame: exact, inside too. Where several nearest points tie (the centre
/// of a sphere, the axis of a capsule, the middle planes of a box) the normal is one of theirs.
SignedDistance signed_distance(const ColliderShape& shape, const Eigen::Vector3d& p);

struct Collider {
  ColliderShape shape;
  Eigen::Isometry3d world_from_shape = Eigen::Isometry3d::Identity();  ///< at rest
  Motion motion;
  double friction = 0;  ///< Coulomb coefficient >= 0

  /// world_from_shape at time t
  Eigen::Isometry3d pose(double t) const { return motion.pose(t) * world_from_shape; }
};

}  // namespace softreel::sim
