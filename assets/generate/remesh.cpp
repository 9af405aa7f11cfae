#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "assets/generate/polygonize.h"

namespace softreel::generate {
namespace {

using Edge = std::pair<int, int>;

Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class Remesher {
 public:
  Remesher(sim::TriangleMesh& mesh, const Field& field, const Field& length)
      : m_(mesh), field_(field), length_(length) {}

  void round() {
    split();
    collapse();
    flip();
    relax();
  }

 private:
  const Vec3& at(int v) const { return m_.vertices[static_cast<std::size_t>(v)]; }
  double wanted(int a, int b) const { return length_((at(a) + at(b)) / 2); }
  double length(int a, int b) const { return (at(a) - at(b)).norm(); }

  /// Edges with their two faces, in the order of the vertex numbers.
  std::map<Edge, std::vector<int>> edges() const {
    std::map<Edge, std::vector<int>> faces;
    for (std::size_t f = 0; f < m_.triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        faces[edge(m_.triangles[f][k], m_.triangles[f][(k + 1) % 3])].push_back(static_cast<int>(f));
      }
    }
    return faces;
  }

  static int opposite(const sim::Triangle& t, const Edge& e) {
    for (const int v : t) {
      if (v != e.first && v != e.second) return v;
    }
    return -1;
  }

  /// Every face is touched at most once a pass, so that the edge table stays right.
  void split() {
    std::vector<char> touched(m_.triangles.size(), 0);
    for (const auto& [e, faces] : edges()) {
      if (length(e.first, e.second) < 4.0 / 3.0 * wanted(e.first, e.second)) continue;
      if (std::any_of(faces.begin(), faces.end(), [&](int f) { return touched[static_cast<std::size_t>(f)]; }))
        continue;
      const int middle = static_cast<int>(m_.vertices.size());
      m_.vertices.push_back(project(field_, (at(e.first) + at(e.second)) / 2));
      for (const int f : faces) {
        touched[static_cast<std::size_t>(f)] = 1;
        sim::Triangle other = m_.triangles[static_cast<std::size_t>(f)];
        std::replace(other.begin(), other.end(), e.first, middle);
        auto& t = m_.triangles[static_cast<std::size_t>(f)];
        std::replace(t.begin(), t.end(), e.second, middle);
        m_.triangles.push_back(other);
      }
    }
  }

  std::vector<std::vector<int>> faces_of_vertices() const {
    std::vector<std::vector<int>> faces(m_.vertices.size());
    for (std::size_t f = 0; f < m_.triangles.size(); ++f) {
      for (const int v : m_.triangles[f]) faces[static_cast<std::size_t>(v)].push_back(static_cast<int>(f));
    }
    return faces;
  }

  std::set<int> neighbours(const std::vector<int>& faces, int v) const {
    std::set<int> found;
    for (const int f : faces) {
      for (const int w : m_.triangles[static_cast<std::size_t>(f)]) {
        if (w != v) found.insert(w);
      }
    }
    return found;
  }

  void collapse() {
    const auto faces = faces_of_vertices();
    std::vector<char> touched(m_.vertices.size(), 0);
    std::vector<char> dead(m_.triangles.size(), 0);
    for (const auto& [e, pair] : edges()) {
      const auto [a, b] = e;
      if (length(a, b) > 0.8 * wanted(a, b)) continue;
      const std::set<int> na = neighbours(faces[static_cast<std::size_t>(a)], a);
      const std::set<int> nb = neighbours(faces[static_cast<std::size_t>(b)], b);
      if (!may_collapse(a, b, na, nb, faces[static_cast<std::size_t>(b)], touched)) continue;
      for (const int v : na) touched[static_cast<std::size_t>(v)] = 1;
      for (const int v : nb) touched[static_cast<std::size_t>(v)] = 1;
      for (const int f : faces[static_cast<std::size_t>(b)]) {
        auto& t = m_.triangles[static_cast<std::size_t>(f)];
        std::replace(t.begin(), t.end(), b, a);
      }
      for (const int f : pair) dead[static_cast<std::size_t>(f)] = 1;
    }
    std::vector<sim::Triangle> kept;
    for (std::size_t f = 0; f < dead.size(); ++f) {
      if (!dead[f]) kept.push_back(m_.triangles[f]);
    }
    m_.triangles = std::move(kept);
    compact();
  }

  /// The link condition keeps the surface manifold; no new edge too long, no face turned over.
  bool may_collapse(int a, int b, const std::set<int>& na, const std::set<int>& nb, const std::vector<int>& faces_b,
                    const std::vector<char>& touched) const {
    int common = 0;
    for (const int v : nb) common += static_cast<int>(na.count(v));
    if (common != 2 || na.size() < 4 || nb.size() < 4) return false;
    for (const int v : na) {
      if (touched[static_cast<std::size_t>(v)]) return false;
    }
    for (const int v : nb) {
      if (touched[static_cast<std::size_t>(v)] || (v != a && length(a, v) > 4.0 / 3.0 * wanted(a, v))) return false;
    }
    for (const int f : faces_b) {
      const sim::Triangle& t = m_.triangles[static_cast<std::size_t>(f)];
      if (std::find(t.begin(), t.end(), a) != t.end()) continue;
      sim::Triangle moved = t;
      std::replace(moved.begin(), moved.end(), b, a);
      if (normal(t).dot(normal(moved)) < 0.5) return false;
    }
    return true;
  }

  Vec3 normal(const sim::Triangle& t) const { return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized(); }

  void compact() {
    std::vector<int> number(m_.vertices.size(), -1);
    std::vector<Vec3> kept;
    for (sim::Triangle& t : m_.triangles) {
      for (int& v : t) {
        int& n = number[static_cast<std::size_t>(v)];
        if (n < 0) {
          n = static_cast<int>(kept.size());
          kept.push_back(at(v));
        }
        v = n;
      }
    }
    m_.vertices = std::move(kept);
  }

  void flip() {
    std::vector<int> valence(m_.vertices.size(), 0);
    const auto table = edges();
    for (const auto& entry : table) {
      ++valence[static_cast<std::size_t>(entry.first.first)];
      ++valence[static_cast<std::size_t>(entry.first.second)];
    }
    std::vector<char> touched(m_.triangles.size(), 0);
    const auto off = [&](int v, int change) {
      const int d = valence[static_cast<std::size_t>(v)] + change - 6;
      return d * d;
    };
    for (const auto& [e, faces] : table) {
      auto& f = m_.triangles[static_cast<std::size_t>(faces[0])];
      auto& g = m_.triangles[static_cast<std::size_t>(faces[1])];
      if (touched[static_cast<std::size_t>(faces[0])] || touched[static_cast<std::size_t>(faces[1])]) continue;
      const auto [a, b] = e;
      const int c = opposite(f, e), d = opposite(g, e);
      if (table.count(edge(c, d)) || made_.count(edge(c, d))) continue;
      const int now = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
      const int then = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
      if (then >= now) continue;
      // f holds a b in some direction; the new faces keep it.
      sim::Triangle nf = f, ng = g;
      std::replace(nf.begin(), nf.end(), b, d);
      std::replace(ng.begin(), ng.end(), a, c);
      if (normal(nf).dot(normal(f)) < 0.8 || normal(ng).dot(normal(g)) < 0.8) continue;
      f = nf;
      g = ng;
      made_.insert(edge(c, d));
      touched[static_cast<std::size_t>(faces[0])] = touched[static_cast<std::size_t>(faces[1])] = 1;
      --valence[static_cast<std::size_t>(a)];
      --valence[static_cast<std::size_t>(b)];
      ++valence[static_cast<std::size_t>(c)];
      ++valence[static_cast<std::size_t>(d)];
    }
    made_.clear();
  }

  void relax() {
    std::vector<Vec3> sum(m_.vertices.size(), Vec3::Zero());
    std::vector<double> weight(m_.vertices.size(), 0);
    for (const sim::Triangle& t : m_.triangles) {
      const Vec3 center = (at(t[0]) + at(t[1]) + at(t[2])) / 3;
      const double h = length_(center);
      const double area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / (h * h);
      for (const int v : t) {
        sum[static_cast<std::size_t>(v)] += area * center;
        weight[static_cast<std::size_t>(v)] += area;
      }
    }
    for (std::size_t v = 0; v < sum.size(); ++v) {
      const Vec3 n = gradient(field_, m_.vertices[v]).normalized();
      const Vec3 step = sum[v] / weight[v] - m_.vertices[v];
      m_.vertices[v] = project(field_, m_.vertices[v] + 0.8 * (step - n * n.dot(step)));
    }
  }

  sim::TriangleMesh& m_;
  const Field& field_;
  const Field& length_;
  std::set<Edge> made_;
};

}  // namespace

void remesh(sim::TriangleMesh& mesh, const Field& field, const Field& edge_length, int rounds) {
  Remesher remesher(mesh, field, edge_length);
  for (int i = 0; i < rounds; ++i) remesher.round();
}

}  // namespace softreel::generate
