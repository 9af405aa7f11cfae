#include "sim/collider.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softreel::sim {
namespace {

SignedDistance from_point(const Eigen::Vector3d& offset, double radius) {
  const double length = offset.norm();
  return {length - radius, length > 0 ? Eigen::Vector3d(offset / length) : Eigen::Vector3d::UnitY()};
}

struct DistanceFrom {
  const Eigen::Vector3d& p;

  SignedDistance operator()(const PlaneShape&) const { return {p.y(), Eigen::Vector3d::UnitY()}; }

  SignedDistance operator()(const SurfaceShape&) const {
    return {std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitY()};
  }

  SignedDistance operator()(const SphereShape& s) const { return from_point(p, s.radius); }

  SignedDistance operator()(const BoxShape& s) const {
    const Eigen::Vector3d over = p.cwiseAbs() - s.half;
    const Eigen::Vector3d outside = over.cwiseMax(0.0);
    const double length = outside.norm();
    const auto sign = [&](int i) { return p(i) < 0 ? -1.0 : 1.0; };
    if (length > 0) {
      Eigen::Vector3d normal = outside / length;
      for (int i = 0; i < 3; ++i) normal(i) *= sign(i);
      return {length, normal};
    }
    int nearest = 0;
    const double depth = over.maxCoeff(&nearest);
    return {depth, sign(nearest) * Eigen::Vector3d::Unit(nearest)};
  }

  SignedDistance operator()(const CapsuleShape& s) const {
    const Eigen::Vector3d axis(0, std::clamp(p.y(), -s.half, s.half), 0);
    return from_point(p - axis, s.radius);
  }
};

}  // namespace

SignedDistance signed_distance(const ColliderShape& shape, const Eigen::Vector3d& p) {
  return std::visit(DistanceFrom{p}, shape);
}

}  // namespace softreel::sim
