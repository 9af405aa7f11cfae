#include "sim/nearest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>

namespace softreel::sim {

Vec3 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 / (d1 - d3);
    return {1 - s, s, 0};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 / (d2 - d6);
    return {1 - s, 0, s};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - s, s};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

NearestPointTree::NearestPointTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles)
    : vertices_(vertices), triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

Vec3 NearestPointTree::corner(int triangle, size_t k) const {
  return vertices_[static_cast<size_t>(triangles_[static_cast<size_t>(triangle)][k])];
}

int NearestPointTree::build(int first, int count) {
  const int node = static_cast<int>(nodes_.size());
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity()), hi = -lo;
  for (int i = first; i < first + count; ++i)
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 p = corner(order_[static_cast<size_t>(i)], k);
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
  nodes_.push_back({lo, hi, first, count, 0});
  constexpr int kLeaf = 4;
  if (count <= kLeaf) return node;
  Eigen::Index axis = 0;
  (hi - lo).maxCoeff(&axis);
  const auto key = [&](int t) { return corner(t, 0)(axis) + corner(t, 1)(axis) + corner(t, 2)(axis); };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](int s, int t) {
    const double ks = key(s), kt = key(t);
    return ks < kt || (ks == kt && s < t);
  });
  build(first, count / 2);
  const int right = build(first + count / 2, count - count / 2);
  nodes_[static_cast<size_t>(node)].right = right;
  return node;
}

double NearestPointTree::distance_to_box(int node, const Vec3& p) const {
  const Node& n = nodes_[static_cast<size_t>(node)];
  return (p - p.cwiseMax(n.lo).cwiseMin(n.hi)).norm();
}

void NearestPointTree::search(int node, const Vec3& p, NearestPoint& best) const {
  const Node& n = nodes_[static_cast<size_t>(node)];
  if (n.right == 0) {
    for (int i = n.first; i < n.first + n.count; ++i) {
      const int t = order_[static_cast<size_t>(i)];
      const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
      const Vec3 w = nearest_weights(p, a, b, c);
      const double distance = (p - (w(0) * a + w(1) * b + w(2) * c)).norm();
      if (best.triangle < 0 || distance < best.distance || (distance == best.distance && t < best.triangle))
        best = {t, w, distance};
    }
    return;
  }
  int near = node + 1, far = n.right;
  double to_near = distance_to_box(near, p), to_far = distance_to_box(far, p);
  if (to_far < to_near) {
    std::swap(near, far);
    std::swap(to_near, to_far);
  }
  if (best.triangle < 0 || to_near <= best.distance) search(near, p, best);
  if (to_far <= best.distance) search(far, p, best);
}

NearestPoint NearestPointTree::find(const Vec3& p) const {
  NearestPoint best;
  if (!nodes_.empty()) search(0, p, best);
  return best;
}

}  // namespace softreel::sim
