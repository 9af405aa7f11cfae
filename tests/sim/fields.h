#pragma once
// What tests of scalar fields have in common: meshes, the first mode of the unit square, errors against it.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "sim/field.h"
#include "sim/grids.h"
#include "sim/mesh_topology.h"

namespace softreel::tests {

using namespace sim;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kHot = 5;

inline FieldFunction constant(double c) {
  return {[c](const Vec3&, double) { return c; }, false};
}
inline FieldFunction steady(double (*f)(const Vec3&)) {
  return {[f](const Vec3& x, double) { return f(x); }, false};
}
inline FieldFunction in_time(double (*f)(const Vec3&, double)) { return {f, true}; }

inline FixedValues boundary_of(const TriangleMesh& mesh, FieldFunction value) {
  return {boundary_vertices(mesh), std::move(value)};
}

/// Unit square in the xz plane, corners at +-1/2.
inline TriangleMesh square(int cells) { return grid_sheet(1, 1, cells, cells); }

/// The same with its inner vertices moved by up to 0.3 of a cell, the same way in every run.
inline TriangleMesh uneven_square(int cells) {
  TriangleMesh mesh = square(cells);
  std::vector<bool> outer(mesh.vertices.size(), false);
  for (int v : boundary_vertices(mesh)) outer[static_cast<size_t>(v)] = true;
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double a = std::fmod(0.754877666 * static_cast<double>(i + 1), 1.0);
    const double b = std::fmod(0.569840291 * static_cast<double>(i + 1), 1.0);
    if (!outer[i]) mesh.vertices[i] += 0.3 / cells * Vec3(2 * a - 1, 0, 2 * b - 1);
  }
  return mesh;
}

/// Unit sphere: every triangle of an octahedron cut into n^2.
inline TriangleMesh sphere(int n) {
  TriangleMesh mesh;
  std::map<std::array<long, 3>, int> at;
  const auto vertex = [&](const Vec3& p) {
    const std::array<long, 3> key{std::lround(p.x() * n), std::lround(p.y() * n), std::lround(p.z() * n)};
    const auto [place, added] = at.emplace(key, static_cast<int>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(p.normalized());
    return place->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 a(octant & 1 ? 1 : -1, 0, 0), b(0, octant & 2 ? 1 : -1, 0), c(0, 0, octant & 4 ? 1 : -1);
    const bool turned = a.cross(b).dot(c) < 0;
    const auto point = [&](int i, int j) { return vertex(((n - i - j) * a + i * b + j * c) / n); };
    const auto add = [&](int p, int q, int r) {
      mesh.triangles.push_back(turned ? Triangle{p, r, q} : Triangle{p, q, r});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < n) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
  }
  return mesh;
}

// Zero on the boundary of the unit square around the origin; -Laplace of it is 2 pi^2 times itself.
inline double mode(const Vec3& p) { return std::sin(kPi * (p.x() + 0.5)) * std::sin(kPi * (p.z() + 0.5)); }
inline Vec3 mode_gradient(const Vec3& p) {
  const double x = kPi * (p.x() + 0.5), z = kPi * (p.z() + 0.5);
  return {kPi * std::cos(x) * std::sin(z), 0, kPi * std::sin(x) * std::cos(z)};
}

struct SpaceErrors {
  double l2 = 0, h1 = 0;
};

/// Of the piecewise linear u against `mode`, by the seven-point rule of degree 5 (Dunavant 1985).
inline SpaceErrors errors_against_mode(const TriangleMesh& mesh, const Eigen::VectorXd& u) {
  constexpr double a = 0.470142064105115, b = 0.101286507323456;
  constexpr double wa = 0.132394152788506, wb = 0.125939180544827;
  struct Point {
    double l0, l1, l2, w;
  };
  const Point points[] = {{1.0 / 3, 1.0 / 3, 1.0 / 3, 0.225},
                          {a, a, 1 - 2 * a, wa},
                          {a, 1 - 2 * a, a, wa},
                          {1 - 2 * a, a, a, wa},
                          {b, b, 1 - 2 * b, wb},
                          {b, 1 - 2 * b, b, wb},
                          {1 - 2 * b, b, b, wb}};
  SpaceErrors sum;
  for (size_t e = 0; e < mesh.triangles.size(); ++e) {
    const HatTriangle hats = hat_triangle(mesh, static_cast<int>(e));
    const Triangle& t = mesh.triangles[e];
    Vec3 gradient = Vec3::Zero();
    for (size_t k = 0; k < 3; ++k) gradient += u(t[k]) * hats.gradient[k];
    for (const Point& q : points) {
      const Vec3 x = q.l0 * mesh.vertices[static_cast<size_t>(t[0])] + q.l1 * mesh.vertices[static_cast<size_t>(t[1])] +
                     q.l2 * mesh.vertices[static_cast<size_t>(t[2])];
      const double value = q.l0 * u(t[0]) + q.l1 * u(t[1]) + q.l2 * u(t[2]);
      sum.l2 += q.w * hats.area * std::pow(value - mode(x), 2);
      sum.h1 += q.w * hats.area * (gradient - mode_gradient(x)).squaredNorm();
    }
  }
  return {std::sqrt(sum.l2), std::sqrt(sum.h1)};
}

inline Eigen::VectorXd at_vertices(const TriangleMesh& mesh, double (*f)(const Vec3&)) {
  Eigen::VectorXd u(static_cast<Eigen::Index>(mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i) u(static_cast<Eigen::Index>(i)) = f(mesh.vertices[i]);
  return u;
}

inline void must_step(Field& field, double h, int steps) {
  for (int i = 0; i < steps; ++i) {
    const StepReport report = field.step(h);
    REQUIRE_MESSAGE(report.converged, report.reason);
  }
}

inline FieldProblem standing_mode(const std::string& equation, const TriangleMesh& mesh) {
  FieldProblem p;
  p.equation = equation;
  p.mesh = mesh;
  p.initial = steady(mode);
  p.fixed = {boundary_of(mesh, constant(0))};
  return p;
}

/// What M u' = -K u (or M u'' = -K u, from rest) does exactly: through the eigenvectors of the free vertices.
class SemiDiscrete {
 public:
  explicit SemiDiscrete(const Field& field) {
    const TriangleMesh& mesh = field.problem().mesh;
    std::vector<bool> held(mesh.vertices.size(), false);
    for (const FixedValues& f : field.problem().fixed)
      for (int v : f.vertices) held[static_cast<size_t>(v)] = true;
    for (size_t i = 0; i < held.size(); ++i)
      if (!held[i]) free_.push_back(static_cast<int>(i));
    const Eigen::MatrixXd K = field.stiffness(), M = field.mass();
    vectors_.compute(K(free_, free_), M(free_, free_));
    start_ = vectors_.eigenvectors().transpose() * M(free_, free_) * field.value()(free_);
  }
  const Eigen::VectorXd& eigenvalues() const { return vectors_.eigenvalues(); }
  template <class F>
  Eigen::VectorXd at(const F& factor) const {
    return vectors_.eigenvectors() * start_.cwiseProduct(vectors_.eigenvalues().unaryExpr(factor));
  }
  const std::vector<int>& free() const { return free_; }

 private:
  std::vector<int> free_;
  Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> vectors_;
  Eigen::VectorXd start_;
};

inline double order_of(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace softreel::tests
