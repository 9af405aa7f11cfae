// Which features of two triangles whose boxes meet are candidates.
#include <algorithm>
#include <cmath>

#include "sim/contact/contact_candidates.h"

namespace softreel::sim {
namespace {

constexpr int kMostPieces = 8;  // of the way of a pair, after which it counts as a candidate
// A surface's own features keep away from each other by half of what they were apart at rest.
constexpr double kShareOfRest = 0.5;

/// A bound from below of a pair's distance at a tenth of its price: what lies between the two along the line of their
/// middles. Neighbours in a flat sheet are told apart by it.
double least_distance(PairKind kind, const FourPoints& x) {
  const bool point = kind == PairKind::kPointTriangle;
  const Vec3 a = point ? x[0] : Vec3(0.5 * (x[0] + x[1])),
             b = point ? Vec3((x[1] + x[2] + x[3]) / 3) : Vec3(0.5 * (x[2] + x[3]));
  const Vec3 axis = b - a;
  const double length2 = axis.squaredNorm();
  if (!(length2 > 0)) return 0;
  const double p0 = axis.dot(x[0]), p1 = axis.dot(x[1]), p2 = axis.dot(x[2]), p3 = axis.dot(x[3]);
  const double between = point ? std::min({p1, p2, p3}) - p0 : std::min(p2, p3) - std::max(p0, p1);
  return between / std::sqrt(length2);
}

}  // namespace

/// Boxes meet long before features do. Goes along the common way, by pieces on which the pair cannot come nearer than
/// what it may be off.
bool ContactCandidates::may_meet(PairKind kind, const SurfacePair& pair, int pair_number, const Candidate& c) const {
  FourPoints x, m;
  double radius[4], speed[4];
  const std::array<int, 4> v = vertices(kind, c);
  Vec3 mean = Vec3::Zero();
  for (size_t i = 0; i < 4; ++i) {
    x[i] = start_[static_cast<size_t>(v[i])];
    m[i] = move_[static_cast<size_t>(v[i])];
    mean += 0.25 * m[i];
    radius[i] = radius_[static_cast<size_t>(v[i])];
  }
  for (size_t i = 0; i < 4; ++i) speed[i] = (m[i] - mean).norm();
  const auto both = [kind](const double* n) {
    return kind == PairKind::kPointTriangle ? n[0] + std::max({n[1], n[2], n[3]})
                                            : std::max(n[0], n[1]) + std::max(n[2], n[3]);
  };
  const double fastest = both(speed);
  double near = both(radius) + pair.offset + static_cast<double>(c.reach);
  if (pair.a != pair.b) near += shift_[static_cast<size_t>(pair_number)];
  double s = 0;
  for (int piece = 0; piece < kMostPieces; ++piece) {
    FourPoints at;
    for (size_t i = 0; i < 4; ++i) at[i] = x[i] + s * (m[i] - mean);
    // Rounding of either stays far below a billionth of the coordinates' spread.
    double room = least_distance(kind, at) * (1 - 1e-9) - near;
    if (!(room > 0) || s + room / fastest < 1) room = pair_distance(kind, at) * (1 - 1e-9) - near;
    if (room <= 0) return true;
    s += room / fastest;
    if (!(s < 1)) return false;
  }
  return true;
}

/// d_hat of a pair that may be close at rest. False if it touches there: such a pair is left alone.
bool ContactCandidates::close_reach(PairKind kind, const SurfacePair& pair, Candidate& c) const {
  if (!pair.close_at_rest) return true;
  FourPoints x;
  const std::array<int, 4> v = vertices(kind, c);
  for (size_t i = 0; i < 4; ++i) x[i] = surfaces_.rest[static_cast<size_t>(v[i])];
  const double gap = pair_distance(kind, x) - pair.offset;
  if (gap <= 0) return false;
  c.reach = static_cast<float>(std::min(static_cast<double>(c.reach), kShareOfRest * gap));
  return true;
}

/// Most are told by where they are now; where they were at rest is looked at for the others.
bool ContactCandidates::is_candidate(PairKind kind, const SurfacePair& pair, int pair_number, Candidate& c) const {
  if (!may_meet(kind, pair, pair_number, c)) return false;
  const float reach = c.reach;
  return close_reach(kind, pair, c) && (c.reach == reach || may_meet(kind, pair, pair_number, c));
}

void ContactCandidates::add_features(const BoxTree::Pair& triangles, const SurfacePair& pair, int pair_number,
                                     const Box3f* shifts, std::vector<Candidate>& points,
                                     std::vector<Candidate>& edges) const {
  const auto reach = static_cast<float>(reach_);
  const auto meet = [&](const Box3f& of_a, const Box3f& of_b) {
    return of_a.meets(shifts ? of_b.swept(*shifts) : of_b);
  };
  const auto t = static_cast<size_t>(triangles.first), u = static_cast<size_t>(triangles.second);
  const Triangle &T = surfaces_.triangles[t], &U = surfaces_.triangles[u];
  const unsigned of_t = surfaces_.stands_for[t], of_u = surfaces_.stands_for[u];
  unsigned shared_t = 0, shared_u = 0;  // bits of vertices that both triangles have
  for (unsigned k = 0; k < 3; ++k)
    for (unsigned l = 0; l < 3; ++l) {
      const auto same = static_cast<unsigned>(T[k] == U[l]);
      shared_t |= same << k;
      shared_u |= same << l;
    }
  const unsigned points_t = of_t & 7 & ~shared_t, points_u = of_u & 7 & ~shared_u;
  for (size_t k = 0; k < 3; ++k) {
    if (points_t >> k & 1 && meet(vertex_box_[static_cast<size_t>(T[k])], triangle_box_[u])) {
      Candidate c{T[k], triangles.second, reach, pair_number};
      if (is_candidate(PairKind::kPointTriangle, pair, pair_number, c)) points.push_back(c);
    }
    if (points_u >> k & 1 && meet(triangle_box_[t], vertex_box_[static_cast<size_t>(U[k])])) {
      Candidate c{U[k], triangles.first, reach, pair_number};
      if (is_candidate(PairKind::kPointTriangle, pair, pair_number, c)) points.push_back(c);
    }
  }
  const unsigned edges_t = of_t >> 3, edges_u = of_u >> 3;
  if (edges_t == 0 || edges_u == 0) return;
  for (size_t k = 0; k < 3; ++k) {
    if (!(edges_t >> k & 1)) continue;
    const int e = surfaces_.triangle_edges[t][k];
    const Box3f& box = edge_box_[static_cast<size_t>(e)];
    for (size_t l = 0; l < 3; ++l) {
      if (!(edges_u >> l & 1)) continue;
      const int f = surfaces_.triangle_edges[u][l];
      const auto &ends = surfaces_.edges[static_cast<size_t>(e)], &others = surfaces_.edges[static_cast<size_t>(f)];
      if (shared_t != 0 &&
          (ends[0] == others[0] || ends[0] == others[1] || ends[1] == others[0] || ends[1] == others[1]))
        continue;
      if (!meet(box, edge_box_[static_cast<size_t>(f)])) continue;
      Candidate c{e, f, reach, pair_number};
      if (pair.a == pair.b && c.a > c.b) std::swap(c.a, c.b);
      if (is_candidate(PairKind::kEdgeEdge, pair, pair_number, c)) edges.push_back(c);
    }
  }
}

}  // namespace softreel::sim
