#include "app/study_points.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/nearest_point.h"

namespace softreel::app {
namespace {

using sim::Vec3;
using Kind = StudyPoints::Body::Kind;

/// Of the tetrahedra the one whose smallest barycentric coordinate is largest: it holds the point, or is nearest to
/// doing so. Linear in the tetrahedra; coordinates are kept as they are, so affine motions are met exactly.
template <class Emit>
void in_tets(const sim::TetMesh& mesh, const std::vector<Vec3>& points, const Emit& emit) {
  std::vector<Eigen::Matrix3d> inverse;
  for (const sim::Tet& t : mesh.tets) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k)
      edges.col(k) =
          mesh.vertices[static_cast<size_t>(t[static_cast<size_t>(k) + 1])] - mesh.vertices[static_cast<size_t>(t[0])];
    inverse.push_back(edges.inverse());
  }
  for (const Vec3& p : points) {
    double best = -std::numeric_limits<double>::infinity();
    std::array<int, 4> vertices = {0, 0, 0, 0};
    std::array<double, 4> weights = {1, 0, 0, 0};
    for (size_t i = 0; i < mesh.tets.size(); ++i) {
      const sim::Tet& t = mesh.tets[i];
      const Vec3 w = inverse[i] * (p - mesh.vertices[static_cast<size_t>(t[0])]);
      const double smallest = std::min(w.minCoeff(), 1 - w.sum());
      if (!(smallest > best)) continue;
      best = smallest;
      vertices = t;
      weights = {1 - w.sum(), w.x(), w.y(), w.z()};
    }
    emit(vertices, weights);
  }
}

template <class Emit>
void on_triangles(const sim::TriangleMesh& mesh, const std::vector<Vec3>& points, const Emit& emit) {
  const sim::NearestPointTree tree(mesh.vertices, mesh.triangles);
  for (const Vec3& p : points) {
    const sim::NearestPoint nearest = tree.find(p);
    const sim::Triangle& t = mesh.triangles[static_cast<size_t>(nearest.triangle)];
    emit({t[0], t[1], t[2], t[0]}, {nearest.weights.x(), nearest.weights.y(), nearest.weights.z(), 0});
  }
}

template <class Emit>
void on_edges(const SpringShape& shape, const std::vector<Vec3>& points, const Emit& emit) {
  for (const Vec3& p : points) {
    double best = std::numeric_limits<double>::infinity(), s = 0;
    std::array<int, 2> ends = {0, 0};
    for (const auto& edge : shape.edges) {
      const Vec3& a = shape.rest[static_cast<size_t>(edge[0])];
      const Vec3 d = shape.rest[static_cast<size_t>(edge[1])] - a;
      const double along = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
      const double distance = (a + along * d - p).norm();
      if (!(distance < best)) continue;
      best = distance;
      s = along;
      ends = edge;
    }
    emit({ends[0], ends[1], ends[0], ends[0]}, {1 - s, s, 0, 0});
  }
}

bool same_points(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

const std::vector<Vec3>& rest_of(const Shapes& shapes, Kind kind, size_t i) {
  return kind == Kind::kSoft    ? shapes.soft[i].rest.vertices
         : kind == Kind::kCloth ? shapes.cloth[i].rest.vertices
                                : shapes.springs[i].rest;
}

/// First vertex of a body in the state: soft, cloth, springs.
int first_of(const Shapes& shapes, Kind kind, size_t index) {
  size_t first = 0;
  const auto add = [&](Kind of, size_t count) {
    for (size_t i = 0; i < count && (of < kind || (of == kind && i < index)); ++i)
      first += rest_of(shapes, of, i).size();
  };
  add(Kind::kSoft, shapes.soft.size());
  add(Kind::kCloth, shapes.cloth.size());
  add(Kind::kSprings, shapes.springs.size());
  return static_cast<int>(first);
}

}  // namespace

size_t StudyPoints::count() const {
  size_t n = 0;
  for (const Body& body : bodies) n += body.rest.size();
  return n;
}

StudyPoints study_points(const assets::Scene& scene, const Shapes& shapes, const std::string& place) {
  StudyPoints points;
  const auto add = [&](Kind kind, const char* section, size_t count) {
    for (size_t i = 0; i < count; ++i)
      if (place.empty() || place == section + std::string(".") + std::to_string(i + 1))
        points.bodies.push_back({kind, i, rest_of(shapes, kind, i), first_of(shapes, kind, i)});
  };
  add(Kind::kSoft, "soft", scene.soft.size());
  add(Kind::kCloth, "cloth", scene.cloth.size());
  add(Kind::kSprings, "springs", scene.springs.size());
  return points;
}

PointMap::PointMap(const StudyPoints& points, const Shapes& shapes) {
  for (const StudyPoints::Body& body : points.bodies) {
    const int first = first_of(shapes, body.kind, body.index);
    const auto emit = [&](std::array<int, 4> vertices, const std::array<double, 4>& weights) {
      for (int& v : vertices) v += first;
      combinations_.push_back({vertices, weights});
    };
    if (same_points(body.rest, rest_of(shapes, body.kind, body.index))) {
      for (size_t i = 0; i < body.rest.size(); ++i) {
        const int v = static_cast<int>(i);
        emit({v, v, v, v}, {1, 0, 0, 0});
      }
    } else if (body.kind == Kind::kSoft) {
      in_tets(shapes.soft[body.index].rest, body.rest, emit);
    } else if (body.kind == Kind::kCloth) {
      on_triangles(shapes.cloth[body.index].rest, body.rest, emit);
    } else {
      on_edges(shapes.springs[body.index], body.rest, emit);
    }
  }
}

Eigen::Matrix3Xd PointMap::at(const Eigen::VectorXd& x) const {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(combinations_.size()));
  for (size_t i = 0; i < combinations_.size(); ++i) {
    const Combination& c = combinations_[i];
    Vec3 p = c.weights[0] * x.segment<3>(3 * c.vertices[0]);
    for (size_t k = 1; k < 4; ++k)
      if (c.weights[k] != 0) p += c.weights[k] * x.segment<3>(3 * c.vertices[k]);
    result.col(static_cast<Eigen::Index>(i)) = p;
  }
  return result;
}

}  // namespace softreel::app
