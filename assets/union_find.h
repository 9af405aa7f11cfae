#pragma once
// Disjoint sets of 0 .. n-1.
#include <cstddef>
#include <numeric>
#include <vector>

namespace softreel::assets {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The smallest member of the set.
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      int& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }

  void join(int a, int b) {
    a = find(a);
    b = find(b);
    if (a < b) {
      parent_[static_cast<std::size_t>(b)] = a;
    } else {
      parent_[static_cast<std::size_t>(a)] = b;
    }
  }

 private:
  std::vector<int> parent_;
};

}  // namespace softreel::assets
