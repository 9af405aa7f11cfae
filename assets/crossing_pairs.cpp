#include "assets/crossing_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "assets/exact_predicates.h"
#include "sim/parallel.h"

namespace softreel::assets {
namespace {

constexpr int kLeafSize = 4;
constexpr std::size_t kParts = 128;  // of a search, about

using Pair = std::pair<int, int>;
using Wanted = std::function<bool(int, int)>;

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

  std::vector<Pair> self_crossings(std::size_t limit, const Wanted& wanted) const {
    if (nodes_.empty()) return {};
    const std::vector<Work> parts = split_up();
    std::vector<std::vector<Pair>> found(parts.size());
    sim::parallel_tasks(static_cast<int>(parts.size()), [&](int k) {
      const auto part = static_cast<std::size_t>(k);
      search(parts[part], {limit, wanted, found[part]});
    });
    std::vector<Pair> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    if (pairs.size() > limit) pairs.resize(limit);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
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

  /// Two nodes whose triangles are to be looked at together; a node with itself.
  struct Work {
    int a, b;
  };
  struct Search {
    std::size_t limit;
    const Wanted& wanted;
    std::vector<Pair>& pairs;

    bool full() const { return pairs.size() >= limit; }
  };

  /// Appends what takes the place of w. False: it cannot be divided.
  bool divide(const Work& w, std::vector<Work>& next) const {
    const Node &a = nodes_[static_cast<std::size_t>(w.a)], &b = nodes_[static_cast<std::size_t>(w.b)];
    if (w.a == w.b) {
      if (a.left < 0) return false;
      next.insert(next.end(), {{a.left, a.left}, {a.right, a.right}, {a.left, a.right}});
      return true;
    }
    if (!a.box.intersects(b.box)) return true;
    if (a.left < 0 && b.left < 0) return false;
    if (b.left < 0 || (a.left >= 0 && a.count >= b.count))
      next.insert(next.end(), {{a.left, w.b}, {a.right, w.b}});
    else
      next.insert(next.end(), {{w.a, b.left}, {w.a, b.right}});
    return true;
  }

  /// Parts of the search, the same for any number of threads.
  std::vector<Work> split_up() const {
    std::vector<Work> parts{{0, 0}};
    for (bool any = true; any && parts.size() < kParts;) {
      any = false;
      std::vector<Work> next;
      for (const Work& w : parts) {
        if (divide(w, next))
          any = true;
        else
          next.push_back(w);
      }
      parts.swap(next);
    }
    return parts;
  }

  void search(const Work& part, const Search& into) const {
    std::vector<Work> stack{part};
    while (!stack.empty() && !into.full()) {
      const Work w = stack.back();
      stack.pop_back();
      if (divide(w, stack)) continue;
      const Node &a = nodes_[static_cast<std::size_t>(w.a)], &b = nodes_[static_cast<std::size_t>(w.b)];
      for (int i = 0; i < a.count; ++i)
        for (int j = w.a == w.b ? i + 1 : 0; j < b.count && !into.full(); ++j) test(a.first + i, b.first + j, into);
    }
  }

  void test(int place_a, int place_b, const Search& into) const {
    if (!box_of(place_a).intersects(box_of(place_b))) return;
    const int a = order_[static_cast<std::size_t>(place_a)], b = order_[static_cast<std::size_t>(place_b)];
    if (into.wanted && !into.wanted(a, b)) return;
    sim::Triangle s = mesh_.triangles[static_cast<std::size_t>(a)], t = mesh_.triangles[static_cast<std::size_t>(b)];
    if (!triangles_cross(mesh_.vertices, s, t)) return;
    std::sort(s.begin(), s.end());
    std::sort(t.begin(), t.end());
    if (s != t) into.pairs.emplace_back(std::min(a, b), std::max(a, b));
  }

  const sim::TriangleMesh& mesh_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<std::pair<int, int>> crossing_pairs(const sim::TriangleMesh& mesh, std::size_t limit,
                                                const std::function<bool(int, int)>& wanted) {
  return BoxTree(mesh).self_crossings(limit, wanted);
}

}  // namespace softreel::assets
