#include "assets/crossing_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "assets/exact_predicates.h"

namespace softreel::assets {
namespace {

constexpr int kLeafSize = 4;

/// Boxes over triangles, split at the median of the longest axis.
class BoxTree {
 public:
  explicit BoxTree(const sim::TriangleMesh& mesh) : mesh_(mesh) {
    boxes_.resize(mesh.triangles.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      for (const int v : mesh.triangles[i]) boxes_[i].extend(mesh.vertices[static_cast<std::size_t>(v)]);
      const sim::Triangle& t = mesh.triangles[i];
      const auto p = [&](std::size_t k) -> const sim::Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
      if (!is_flat(p(0), p(1), p(2))) order_.push_back(static_cast<int>(i));
    }
    if (!order_.empty()) build(0, static_cast<int>(order_.size()));
  }

  std::vector<std::pair<int, int>> self_crossings(std::size_t limit, const std::function<bool(int, int)>& wanted) {
    pairs_.clear();
    limit_ = limit;
    wanted_ = &wanted;
    if (!nodes_.empty()) inside(0);
    std::sort(pairs_.begin(), pairs_.end());
    return std::move(pairs_);
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first, count;  // of order_, in a leaf
    int left = -1, right = -1;
  };

  int build(int first, int last) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({{}, first, last - first});
    Eigen::AlignedBox3d box, centers;
    for (int i = first; i < last; ++i) {
      box.extend(box_of(i));
      centers.extend(box_of(i).center());
    }
    nodes_[static_cast<std::size_t>(index)].box = box;
    if (last - first <= kLeafSize) return index;
    int axis = 0;
    centers.sizes().maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
      const double ca = boxes_[static_cast<std::size_t>(a)].center()[axis];
      const double cb = boxes_[static_cast<std::size_t>(b)].center()[axis];
      return ca != cb ? ca < cb : a < b;
    });
    const int left = build(first, middle);
    const int right = build(middle, last);
    nodes_[static_cast<std::size_t>(index)].left = left;
    nodes_[static_cast<std::size_t>(index)].right = right;
    return index;
  }

  const Eigen::AlignedBox3d& box_of(int place) const {
    return boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(place)])];
  }

  void test(int place_a, int place_b) {
    if (!box_of(place_a).intersects(box_of(place_b))) return;
    const int a = order_[static_cast<std::size_t>(place_a)], b = order_[static_cast<std::size_t>(place_b)];
    if (*wanted_ && !(*wanted_)(a, b)) return;
    sim::Triangle s = mesh_.triangles[static_cast<std::size_t>(a)], t = mesh_.triangles[static_cast<std::size_t>(b)];
    if (!triangles_cross(mesh_.vertices, s, t)) return;
    std::sort(s.begin(), s.end());
    std::sort(t.begin(), t.end());
    if (s != t) pairs_.emplace_back(std::min(a, b), std::max(a, b));
  }

  void inside(int index) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (pairs_.size() >= limit_) return;
    if (node.left >= 0) {
      inside(node.left);
      inside(node.right);
      between(node.left, node.right);
      return;
    }
    for (int i = 0; i < node.count && pairs_.size() < limit_; ++i) {
      for (int j = i + 1; j < node.count && pairs_.size() < limit_; ++j) test(node.first + i, node.first + j);
    }
  }

  void between(int ia, int ib) {
    const Node &a = nodes_[static_cast<std::size_t>(ia)], &b = nodes_[static_cast<std::size_t>(ib)];
    if (pairs_.size() >= limit_ || !a.box.intersects(b.box)) return;
    if (a.left < 0 && b.left < 0) {
      for (int i = 0; i < a.count && pairs_.size() < limit_; ++i) {
        for (int j = 0; j < b.count && pairs_.size() < limit_; ++j) test(a.first + i, b.first + j);
      }
    } else if (b.left < 0 || (a.left >= 0 && a.count >= b.count)) {
      between(a.left, ib);
      between(a.right, ib);
    } else {
      between(ia, b.left);
      between(ia, b.right);
    }
  }

  const sim::TriangleMesh& mesh_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  std::vector<std::pair<int, int>> pairs_;
  std::size_t limit_ = 0;
  const std::function<bool(int, int)>* wanted_ = nullptr;
};

}  // namespace

std::vector<std::pair<int, int>> crossing_pairs(const sim::TriangleMesh& mesh, std::size_t limit,
                                                const std::function<bool(int, int)>& wanted) {
  return BoxTree(mesh).self_crossings(limit, wanted);
}

}  // namespace softreel::assets
