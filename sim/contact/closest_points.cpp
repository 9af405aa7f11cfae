#include "sim/contact/closest_points.h"

#include <algorithm>
#include <cmath>

namespace softreel::sim {
namespace {

using Eigen::Vector3d;

/// Where along a segment from a to b the point nearest to p lies, in [0, 1].
double along(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d u = b - a;
  const double length2 = u.squaredNorm();
  return length2 > 0 ? std::clamp(u.dot(p - a) / length2, 0.0, 1.0) : 0.0;
}

/// Coordinates of the nearest point: of a triangle, the weights of its vertices; of two edges, s and t.
struct OnTriangle {
  double w[3];
  Vector3d r;
};
struct OnEdges {
  double s, t;
  Vector3d r;
};

// Ericson 2005, "Real-time collision detection", section 5.1.5.
OnTriangle on_triangle(const FourPoints& x) {
  const Vector3d &p = x[0], &a = x[1], &b = x[2], &c = x[3];
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const auto at = [&](double wa, double wb, double wc) {
    // Written from a, so that a far origin costs no digits.
    return OnTriangle{{wa, wb, wc}, ap - wb * ab - wc * ac};
  };
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return at(1, 0, 0);
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return at(0, 1, 0);
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return at(0, 0, 1);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (va > 0 && vb > 0 && vc > 0 && sum > 0) return at(1 - vb / sum - vc / sum, vb / sum, vc / sum);
  // On an edge; rounding and flat triangles may point to the wrong one, so the nearest of the three.
  const double tab = along(p, a, b), tac = along(p, a, c), tbc = along(p, b, c);
  OnTriangle best = at(1 - tab, tab, 0);
  for (const OnTriangle& other : {at(1 - tac, 0, tac), at(0, 1 - tbc, tbc)})
    if (other.r.squaredNorm() < best.r.squaredNorm()) best = other;
  return best;
}

// The distance is a convex function of (s, t): its minimum over the square is inside, or on one of the four sides.
// Ericson 2005, section 5.1.9, where the edges are not nearly parallel.
OnEdges on_edges(const FourPoints& x) {
  const Vector3d u = x[1] - x[0], v = x[3] - x[2], between = x[0] - x[2];
  const auto at = [&](double s, double t) { return OnEdges{s, t, between + s * u - t * v}; };
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ub = u.dot(between), vb = v.dot(between);
  const double det = uu * vv - uv * uv;
  if (det > 1e-10 * uu * vv) {
    double s = std::clamp((uv * vb - vv * ub) / det, 0.0, 1.0), t = (uv * s + vb) / vv;
    if (t < 0 || t > 1) {
      t = t < 0 ? 0 : 1;
      s = std::clamp((uv * t - ub) / uu, 0.0, 1.0);
    }
    return at(s, t);
  }
  OnEdges best = at(0, along(x[0], x[2], x[3]));
  const auto consider = [&](const OnEdges& other) {
    if (other.r.squaredNorm() < best.r.squaredNorm()) best = other;
  };
  consider(at(1, along(x[1], x[2], x[3])));
  consider(at(along(x[2], x[0], x[1]), 0));
  consider(at(along(x[3], x[0], x[1]), 1));
  if (det > 0) {  // s has lost its digits, and what is left of them must not make it worse
    const double s = (uv * vb - vv * ub) / det;
    if (s > 0 && s < 1) {
      const double t = (uv * s + vb) / vv;
      if (t > 0 && t < 1) consider(at(s, t));
    }
  }
  return best;
}

}  // namespace

double pair_distance(PairKind kind, const FourPoints& x) {
  return kind == PairKind::kPointTriangle ? on_triangle(x).r.norm() : on_edges(x).r.norm();
}

ClosestPoints closest_points(PairKind kind, const FourPoints& x) {
  ClosestPoints result;
  if (kind == PairKind::kPointTriangle) {
    const OnTriangle c = on_triangle(x);
    result.r = c.r;
    result.weights = {1, -c.w[0], -c.w[1], -c.w[2]};
    int base = -1;
    for (int i = 0; i < 3; ++i) {
      if (c.w[i] == 0) continue;
      if (base < 0) {
        base = i;
        continue;
      }
      // What one vertex gains, the first one loses.
      FourNumbers& rate = result.rates[static_cast<size_t>(result.parameters++)];
      rate[static_cast<size_t>(base + 1)] = 1;
      rate[static_cast<size_t>(i + 1)] = -1;
    }
  } else {
    const OnEdges c = on_edges(x);
    result.r = c.r;
    result.weights = {1 - c.s, c.s, c.t - 1, -c.t};
    if (c.s > 0 && c.s < 1) result.rates[static_cast<size_t>(result.parameters++)] = {-1, 1, 0, 0};
    if (c.t > 0 && c.t < 1) result.rates[static_cast<size_t>(result.parameters++)] = {0, 0, 1, -1};
  }
  result.distance = result.r.norm();
  return result;
}

}  // namespace softreel::sim
