#include "sim/collider_core.h"

#include <algorithm>
#include <cmath>

namespace softreel::sim {
namespace {

constexpr double kDistances = 20, kOfDeepest = 0.9;  // how deep a core lies
constexpr double kKept = 0.1;                        // of the distance from the core, at most of its depth
// Grazing ways take ever shorter pieces; after so many the rest is left to the next step.
constexpr int kMostPieces = 256;

struct Shrink {
  double most;  // [m]
  using Core = std::optional<ColliderCore>;

  double depth(double deepest) const { return std::min(most, kOfDeepest * deepest); }
  Core operator()(const PlaneShape&) const { return {}; }
  Core operator()(const SurfaceShape&) const { return {}; }
  Core operator()(const SphereShape& s) const {
    return ColliderCore{SphereShape{s.radius - depth(s.radius)}, depth(s.radius)};
  }
  Core operator()(const CapsuleShape& s) const {
    return ColliderCore{CapsuleShape{s.radius - depth(s.radius), s.half}, depth(s.radius)};
  }
  Core operator()(const BoxShape& s) const {
    const double less = depth(s.half.minCoeff());
    return ColliderCore{BoxShape{s.half.array() - less}, less};
  }
};

}  // namespace

std::optional<ColliderCore> core_of(const ColliderShape& shape, double distance) {
  return std::visit(Shrink{kDistances * distance}, shape);
}

double free_share(const ColliderCore& core, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double length = (b - a).norm();
  double gap = signed_distance(core.shape, a).distance;
  if (gap <= 0 || gap > length) return 1;
  const double kept = kKept * std::min(gap, core.depth);
  double gone = 0;
  for (int piece = 0; piece < kMostPieces; ++piece) {
    gone += gap - kept;
    if (gone >= length) return 1;
    gap = signed_distance(core.shape, a + gone / length * (b - a)).distance;
    // Pieces that bring less than a hundredth of what has to be kept are not worth their work.
    if (!(gap - kept > 0.01 * kept)) break;
  }
  return gone / length;
}

}  // namespace softreel::sim
