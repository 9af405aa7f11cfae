#include "sim/contact/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace softreel::sim {
namespace {

constexpr int kLeaf = 4;     // triangles
constexpr int kParts = 128;  // of a search, about

// Outwards by one to two units in the last place, without a call.
constexpr float kUlp = 2 * std::numeric_limits<float>::epsilon(), kTiny = std::numeric_limits<float>::min();
float down(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest - kUlp * std::abs(nearest) - kTiny;
}
float up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest + kUlp * std::abs(nearest) + kTiny;
}

double area(const Box3f& box) {
  const Eigen::Array4d size = (box.upper - box.lower).cast<double>();
  return size(0) * size(1) + size(1) * size(2) + size(2) * size(0);
}

}  // namespace

void Box3f::add(const Eigen::Vector3d& point) {
  for (int a = 0; a < 3; ++a) {
    lower(a) = std::min(lower(a), down(point(a)));
    upper(a) = std::max(upper(a), up(point(a)));
  }
}

void Box3f::grow(double margin) {
  for (int a = 0; a < 3; ++a) {
    lower(a) = down(static_cast<double>(lower(a)) - margin);
    upper(a) = up(static_cast<double>(upper(a)) + margin);
  }
}

Box3f Box3f::swept(const Box3f& shifts) const {
  Box3f result;
  for (int a = 0; a < 3; ++a) {
    result.lower(a) = down(static_cast<double>(lower(a)) + static_cast<double>(shifts.lower(a)));
    result.upper(a) = up(static_cast<double>(upper(a)) + static_cast<double>(shifts.upper(a)));
  }
  return result;
}

BoxTree::BoxTree(std::span<const Triangle> triangles, std::span<const Eigen::Vector3d> vertices)
    : triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::Vector3d> middles;
  for (const Triangle& t : triangles)
    middles.push_back((vertices[static_cast<size_t>(t[0])] + vertices[static_cast<size_t>(t[1])] +
                       vertices[static_cast<size_t>(t[2])]) /
                      3);
  build(0, static_cast<int>(triangles.size()), middles);
}

/// Halves along the longest side of the middles' box. Returns the new node.
int BoxTree::build(int first, int count, std::span<const Eigen::Vector3d> middles) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({});
  if (count <= kLeaf) {
    nodes_.back().first = first;
    nodes_.back().count = count;
    return node;
  }
  Eigen::AlignedBox3d box;
  const auto begin = order_.begin() + first;
  for (auto it = begin; it != begin + count; ++it) box.extend(middles[static_cast<size_t>(*it)]);
  int axis;
  box.sizes().maxCoeff(&axis);
  // By place, then by number: the same tree from equal places on every machine.
  std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
    const double pa = middles[static_cast<size_t>(a)](axis), pb = middles[static_cast<size_t>(b)](axis);
    return pa < pb || (pa == pb && a < b);
  });
  build(first, count / 2, middles);
  const int right = build(first + count / 2, count - count / 2, middles);
  nodes_[static_cast<size_t>(node)].right = right;
  return node;
}

void BoxTree::refit(std::span<const Box3f> vertices) {
  // Children stand behind their parents.
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = {};
    if (node.right != 0) {
      node.box.add(nodes_[i + 1].box);
      node.box.add(nodes_[static_cast<size_t>(node.right)].box);
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k)
      for (const int v : triangles_[static_cast<size_t>(order_[static_cast<size_t>(k)])])
        node.box.add(vertices[static_cast<size_t>(v)]);
  }
}

double BoxTree::cost() const {
  double sum = 0;
  for (const Node& node : nodes_) sum += area(node.box);
  return sum / std::max(area(nodes_[0].box), std::numeric_limits<double>::min());
}

namespace {

/// Splits all of `work`, again and again, until there is enough of it for all threads. `split(w, next)` appends what
/// takes the place of w, or nothing where its boxes do not meet; false: w cannot be split, and stays.
template <class Split>
std::vector<BoxTree::Work> split_up(std::vector<BoxTree::Work> work, const Split& split) {
  for (bool any = true; any && !work.empty() && work.size() < kParts;) {
    any = false;
    std::vector<BoxTree::Work> next;
    for (const BoxTree::Work& w : work) {
      if (split(w, next))
        any = true;
      else
        next.push_back(w);
    }
    work.swap(next);
  }
  return work;
}

}  // namespace

/// The children of two nodes, each with each. False if one has none.
bool BoxTree::pair_children(Work w, const BoxTree& other, std::vector<Work>& next) const {
  const Node &a = nodes_[static_cast<size_t>(w.a)], &b = other.nodes_[static_cast<size_t>(w.b)];
  if (a.right == 0 || b.right == 0) return false;
  for (const int i : {w.a + 1, a.right})
    for (const int j : {w.b + 1, b.right}) next.push_back({i, j});
  return true;
}

std::vector<BoxTree::Work> BoxTree::self_work() const {
  return split_up({{0, 0}}, [&](Work w, std::vector<Work>& next) {
    const Node &a = nodes_[static_cast<size_t>(w.a)], &b = nodes_[static_cast<size_t>(w.b)];
    if (w.a != w.b) return !a.box.meets(b.box) || pair_children(w, *this, next);
    if (a.right == 0) return false;
    next.push_back({w.a + 1, w.a + 1});
    next.push_back({w.a + 1, a.right});
    next.push_back({a.right, a.right});
    return true;
  });
}

std::vector<BoxTree::Work> BoxTree::work_with(const BoxTree& other, const Box3f& shifts) const {
  return split_up({{0, 0}}, [&](Work w, std::vector<Work>& next) {
    const Node &a = nodes_[static_cast<size_t>(w.a)], &b = other.nodes_[static_cast<size_t>(w.b)];
    return !a.box.meets(b.box.swept(shifts)) || pair_children(w, other, next);
  });
}

void BoxTree::self_pairs(Work work, std::span<const Box3f> triangles, std::vector<Pair>& pairs) const {
  std::vector<Work> stack{work};
  while (!stack.empty()) {
    const Work w = stack.back();
    stack.pop_back();
    const Node &a = nodes_[static_cast<size_t>(w.a)], &b = nodes_[static_cast<size_t>(w.b)];
    if (w.a != w.b && !a.box.meets(b.box)) continue;
    if (w.a == w.b && a.right != 0) {
      stack.push_back({w.a + 1, w.a + 1});
      stack.push_back({w.a + 1, a.right});
      stack.push_back({a.right, a.right});
    } else if (a.right != 0 && (b.right == 0 || area(a.box) >= area(b.box))) {
      stack.push_back({w.a + 1, w.b});
      stack.push_back({a.right, w.b});
    } else if (b.right != 0) {
      stack.push_back({w.a, w.b + 1});
      stack.push_back({w.a, b.right});
    } else {
      for (int k = a.first; k < a.first + a.count; ++k) {
        const int t = order_[static_cast<size_t>(k)];
        const Box3f& box = triangles[static_cast<size_t>(t)];
        for (int l = w.a == w.b ? k + 1 : b.first; l < b.first + b.count; ++l) {
          const int u = order_[static_cast<size_t>(l)];
          if (box.meets(triangles[static_cast<size_t>(u)])) pairs.emplace_back(std::min(t, u), std::max(t, u));
        }
      }
    }
  }
}

void BoxTree::pairs_with(Work work, const BoxTree& other, const Box3f& shifts, std::span<const Box3f> triangles,
                         std::span<const Box3f> other_triangles, std::vector<Pair>& pairs) const {
  std::vector<Work> stack{work};
  while (!stack.empty()) {
    const Work w = stack.back();
    stack.pop_back();
    const Node &a = nodes_[static_cast<size_t>(w.a)], &b = other.nodes_[static_cast<size_t>(w.b)];
    if (!a.box.meets(b.box.swept(shifts))) continue;
    if (a.right != 0 && (b.right == 0 || area(a.box) >= area(b.box))) {
      stack.push_back({w.a + 1, w.b});
      stack.push_back({a.right, w.b});
    } else if (b.right != 0) {
      stack.push_back({w.a, w.b + 1});
      stack.push_back({w.a, b.right});
    } else {
      for (int l = b.first; l < b.first + b.count; ++l) {
        const int u = other.order_[static_cast<size_t>(l)];
        const Box3f box = other_triangles[static_cast<size_t>(u)].swept(shifts);
        for (int k = a.first; k < a.first + a.count; ++k) {
          const int t = order_[static_cast<size_t>(k)];
          if (triangles[static_cast<size_t>(t)].meets(box)) pairs.emplace_back(t, u);
        }
      }
    }
  }
}

}  // namespace softreel::sim
