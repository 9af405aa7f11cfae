#pragma once
// The point of a triangle surface that is nearest to another point.
#include <span>
#include <vector>

#include "sim/mesh.h"

namespace softreel::sim {

/// Nearest point of the triangle abc to p, as barycentric weights, each >= 0, sum 1 (Ericson 2005, "Real-Time Collision
/// Detection", section 5.1.5). For a triangle without area, one of its points.
Vec3 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

struct NearestPoint {
  int triangle = -1;  ///< -1: there is none
  Vec3 weights = Vec3::Zero();
  double distance = 0;  ///< [m]
};

/// A tree of boxes over fixed triangles. Among points at the same distance that of the first triangle wins.
class NearestPointTree {
 public:
  /// Both must outlive this.
  NearestPointTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  /// O(log n) for points near the surface.
  NearestPoint find(const Vec3& p) const;

 private:
  struct Node {
    Vec3 lo, hi;
    int first, count;  // of order_
    int right;         // the left child is the next node; 0: a leaf
  };
  int build(int first, int count);
  void search(int node, const Vec3& p, NearestPoint& best) const;
  double distance_to_box(int node, const Vec3& p) const;
  Vec3 corner(int triangle, size_t k) const;

  std::span<const Vec3> vertices_;
  std::span<const Triangle> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace softreel::sim
