#pragma once
// A hierarchy of axis-aligned boxes over the triangles of one surface, refitted as it moves.
#include <Eigen/Core>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "sim/mesh.h"

namespace softreel::sim {

/// In single precision, rounded outwards: half the memory traffic. Empty when default-constructed. The fourth lane is
/// zero: a test of two boxes is a handful of vector instructions without a branch.
struct Box3f {
  Eigen::Array4f lower = Eigen::Array4f(kInfinite, kInfinite, kInfinite, 0);
  Eigen::Array4f upper = Eigen::Array4f(-kInfinite, -kInfinite, -kInfinite, 0);

  void add(const Box3f& other) {
    lower = lower.min(other.lower);
    upper = upper.max(other.upper);
  }
  /// Holds the double-precision point.
  void add(const Eigen::Vector3d& point);
  /// At least by `margin` >= 0 on all sides.
  void grow(double margin);
  bool meets(const Box3f& other) const {
    return (lower.max(other.lower) - upper.min(other.upper)).maxCoeff() <= 0;  // signs of differences are exact
  }
  /// Moved by any vector in `shifts`.
  Box3f swept(const Box3f& shifts) const;

 private:
  static constexpr float kInfinite = std::numeric_limits<float>::infinity();
};

/// Built once over the triangles' midpoints; boxes are refitted to those of the vertices. O(n log n), then O(n).
class BoxTree {
 public:
  /// `triangles` index `vertices`; the span must outlive the tree.
  BoxTree(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> vertices);

  /// Boxes of all nodes from those of the vertices.
  void refit(std::span<const Box3f> vertices);
  /// Sum of the nodes' surface areas over that of the root: what a query costs. Grows as the surface crumples away from
  /// how it was when the tree was built.
  double cost() const;
  /// Of everything.
  const Box3f& box() const { return nodes_[0].box; }

  using Pair = std::pair<int, int>;  ///< triangles
  /// Two nodes whose triangles are to be looked at together.
  struct Work {
    int a, b;
  };
  /// Splits the search for pairs within this tree into some independent parts.
  std::vector<Work> self_work() const;
  /// The same for pairs of this one and another, which may stand anywhere in `shifts` relative to it.
  std::vector<Work> work_with(const BoxTree& other, const Box3f& shifts) const;

  /// Appends the pairs (t, u), t < u, of one part whose boxes meet.
  void self_pairs(Work work, std::span<const Box3f> triangles, std::vector<Pair>& pairs) const;
  /// The same for (t of this one, u of the other); boxes of triangles are given for each tree.
  void pairs_with(Work work, const BoxTree& other, const Box3f& shifts, std::span<const Box3f> triangles,
                  std::span<const Box3f> other_triangles, std::vector<Pair>& pairs) const;

 private:
  struct Node {
    Box3f box;
    int right = 0;             // second child; the first one is the next node. 0: a leaf
    int first = 0, count = 0;  // its triangles in order_
  };
  bool pair_children(Work w, const BoxTree& other, std::vector<Work>& next) const;
  int build(int first, int count, std::span<const Eigen::Vector3d> middles);

  std::span<const Triangle> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace softreel::sim
