#include "assets/generate/polygonize.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace softreel::generate {
namespace {

class Marcher {
 public:
  Marcher(const Field& field, const Vec3& low, const Vec3& high, double cell) : low_(low), cell_(cell) {
    for (int k = 0; k < 3; ++k)
      n_[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil((high[k] - low[k]) / cell)) + 1;
    for (int z = 0; z < n_[2]; ++z) {
      for (int y = 0; y < n_[1]; ++y) {
        for (int x = 0; x < n_[0]; ++x) {
          const double v = field(at(index(x, y, z)));
          values_.push_back(v == 0 ? 1e-12 : v);  // a corner is inside or outside, never on the surface
        }
      }
    }
  }

  sim::TriangleMesh run() {
    // Kuhn: the six paths from corner 0 to corner 7 along the axes.
    constexpr int kPaths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
    for (int z = 0; z + 1 < n_[2]; ++z) {
      for (int y = 0; y + 1 < n_[1]; ++y) {
        for (int x = 0; x + 1 < n_[0]; ++x) {
          const auto corner = [&](int c) { return index(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2)); };
          for (const auto& path : kPaths) tet({corner(0), corner(path[0]), corner(path[1]), corner(7)});
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  int index(int x, int y, int z) const { return (z * n_[1] + y) * n_[0] + x; }
  Vec3 at(int i) const { return low_ + cell_ * Vec3(i % n_[0], (i / n_[0]) % n_[1], i / (n_[0] * n_[1])); }
  double value(int i) const { return values_[static_cast<std::size_t>(i)]; }

  int cut(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [found, fresh] = cuts_.try_emplace({a, b}, static_cast<int>(mesh_.vertices.size()));
    if (fresh) {
      const double t = value(a) / (value(a) - value(b));
      mesh_.vertices.push_back(at(a) + std::clamp(t, 0.05, 0.95) * (at(b) - at(a)));
    }
    return found->second;
  }

  void triangle(int a, int b, int c, const Vec3& outward) {
    const auto p = [&](int v) -> const Vec3& { return mesh_.vertices[static_cast<std::size_t>(v)]; };
    if ((p(b) - p(a)).cross(p(c) - p(a)).dot(outward) < 0) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  void tet(const std::array<int, 4>& corners) {
    std::vector<int> in, out;
    Vec3 center_in = Vec3::Zero(), center_out = Vec3::Zero();
    for (const int c : corners) {
      (value(c) < 0 ? in : out).push_back(c);
      (value(c) < 0 ? center_in : center_out) += at(c);
    }
    if (in.empty() || out.empty()) return;
    const Vec3 outward = center_out / static_cast<double>(out.size()) - center_in / static_cast<double>(in.size());
    if (in.size() == 2) {
      const int a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]), d = cut(in[1], out[0]);
      triangle(a, b, c, outward);
      triangle(a, c, d, outward);
    } else {
      const std::vector<int>& lone = in.size() == 1 ? in : out;
      const std::vector<int>& rest = in.size() == 1 ? out : in;
      triangle(cut(lone[0], rest[0]), cut(lone[0], rest[1]), cut(lone[0], rest[2]), outward);
    }
  }

  Vec3 low_;
  double cell_;
  std::array<int, 3> n_;
  std::vector<double> values_;
  std::map<std::pair<int, int>, int> cuts_;
  sim::TriangleMesh mesh_;
};

}  // namespace

sim::TriangleMesh polygonize(const Field& field, const Vec3& low, const Vec3& high, double cell) {
  return Marcher(field, low, high, cell).run();
}

}  // namespace softreel::generate
