#include "assets/exact_predicates.h"

#include <array>
#include <cmath>

namespace softreel::assets {
namespace {

/// A number as a sum of doubles that do not overlap, smallest first. Rarely needed, so plain vectors do.
using Expansion = std::vector<double>;

void two_sum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double bv = sum - a;
  error = (a - (sum - bv)) + (b - bv);
}

/// e + b (Shewchuk's Grow-Expansion, zeros left out).
Expansion grow(const Expansion& e, double b) {
  Expansion h;
  h.reserve(e.size() + 1);
  double q = b;
  for (const double component : e) {
    double sum, error;
    two_sum(q, component, sum, error);
    q = sum;
    if (error != 0) h.push_back(error);
  }
  if (q != 0) h.push_back(q);
  return h;
}

Expansion add(Expansion a, const Expansion& b) {
  for (const double component : b) a = grow(a, component);
  return a;
}

Expansion negate(Expansion a) {
  for (double& component : a) component = -component;
  return a;
}

Expansion multiply(const Expansion& a, const Expansion& b) {
  Expansion product;
  for (const double x : a) {
    for (const double y : b) {
      const double high = x * y;
      product = grow(grow(product, std::fma(x, y, -high)), high);
    }
  }
  return product;
}

Expansion difference(double a, double b) { return grow(grow({}, -b), a); }

int sign(const Expansion& e) { return e.empty() ? 0 : (e.back() > 0 ? 1 : -1); }

int orient3d_exact(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, const sim::Vec3& d) {
  std::array<std::array<Expansion, 3>, 3> m;
  const std::array<const sim::Vec3*, 3> rows = {&b, &c, &d};
  for (std::size_t r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) m[r][static_cast<std::size_t>(k)] = difference((*rows[r])[k], a[k]);
  }
  Expansion det;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Expansion minor = add(multiply(m[0][i], m[1][j]), negate(multiply(m[0][j], m[1][i])));
    det = add(std::move(det), multiply(minor, m[2][k]));
  }
  return sign(det);
}

/// Closed segments p q and a b that lie in one plane, seen along `drop`.
bool segments_meet(const sim::Vec3& p, const sim::Vec3& q, const sim::Vec3& a, const sim::Vec3& b, int drop) {
  const int pa = orient2d_sign(a, b, p, drop), qa = orient2d_sign(a, b, q, drop);
  const int ap = orient2d_sign(p, q, a, drop), bp = orient2d_sign(p, q, b, drop);
  if (pa * qa < 0 && ap * bp < 0) return true;
  // An end on the other segment: on its line and within its box.
  const auto within = [](const sim::Vec3& x, const sim::Vec3& u, const sim::Vec3& v) {
    return (x.array() >= u.cwiseMin(v).array()).all() && (x.array() <= u.cwiseMax(v).array()).all();
  };
  return (pa == 0 && within(p, a, b)) || (qa == 0 && within(q, a, b)) || (ap == 0 && within(a, p, q)) ||
         (bp == 0 && within(b, p, q));
}

bool lie_in_an_axis_plane(int axis, const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) {
  return a[axis] == b[axis] && a[axis] == c[axis];
}

/// u . v beyond doubt; 0: rounding could have turned it. Rows are differences of given points: three roundings in a
/// product and two in the sum stay below 5 * 2^-53 (1 + small) of |u|_i |v|_i, which 1e-15 leaves room above.
int sure_sign_of_dot(const sim::Vec3& u, const sim::Vec3& v) {
  const double dot = u.dot(v), bound = 1e-15 * u.cwiseAbs().dot(v.cwiseAbs());
  return dot > bound ? 1 : (dot < -bound ? -1 : 0);
}

/// Does a plane through `p` part u from v (two points each) strictly? Tries one plane: no means nothing.
bool parted_at(const sim::Vec3& p, const sim::Vec3& u1, const sim::Vec3& u2, const sim::Vec3& v1, const sim::Vec3& v2) {
  const sim::Vec3 a = u1 - p, b = u2 - p, c = v1 - p, d = v2 - p;
  const sim::Vec3 normal = a.normalized() + b.normalized() - c.normalized() - d.normalized();
  return sure_sign_of_dot(normal, a) > 0 && sure_sign_of_dot(normal, b) > 0 && sure_sign_of_dot(normal, c) < 0 &&
         sure_sign_of_dot(normal, d) < 0;
}

/// Triangles a b c and a b f: do they open by more than a right angle? Then their planes' halves beyond the edge have
/// nothing in common.
bool opens_wide(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, const sim::Vec3& f) {
  const sim::Vec3 edge = b - a, u = c - a, v = f - a;
  // (edge x u) . (edge x v) = |edge|^2 (u . v) - (edge . u)(edge . v)
  const double uv = u.dot(v), eu = edge.dot(u), ev = edge.dot(v), ee = edge.squaredNorm();
  return ee * uv - eu * ev < -1e-14 * ee * u.norm() * v.norm();
}

/// Triangles without a vertex in common, as `parted_at`: by the plane halfway between their centres.
bool parted(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, const sim::Vec3& d, const sim::Vec3& e,
            const sim::Vec3& f) {
  const sim::Vec3 normal = (a + b + c) - (d + e + f);
  for (const sim::Vec3* u : {&a, &b, &c})
    for (const sim::Vec3* v : {&d, &e, &f})
      if (sure_sign_of_dot(normal, *u - *v) <= 0) return false;
  return true;
}

int visible_axis(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) {
  for (int drop = 0; drop < 3; ++drop) {
    if (orient2d_sign(a, b, c, drop) != 0) return drop;
  }
  return -1;
}

/// Closed segment p q against closed triangle a b c with area.
bool segment_meets_triangle(const sim::Vec3& p, const sim::Vec3& q, const sim::Vec3& a, const sim::Vec3& b,
                            const sim::Vec3& c) {
  const int sp = orient3d_sign(a, b, c, p), sq = orient3d_sign(a, b, c, q);
  if (sp * sq > 0) return false;
  if (sp != 0 || sq != 0) {  // one point in common with the plane: is it on the same side of all three edges?
    const int u = orient3d_sign(p, q, a, b), v = orient3d_sign(p, q, b, c), w = orient3d_sign(p, q, c, a);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  }
  const int drop = visible_axis(a, b, c);
  const auto inside = [&](const sim::Vec3& x) {
    const int u = orient2d_sign(a, b, x, drop), v = orient2d_sign(b, c, x, drop), w = orient2d_sign(c, a, x, drop);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  };
  return inside(p) || inside(q) || segments_meet(p, q, a, b, drop) || segments_meet(p, q, b, c, drop) ||
         segments_meet(p, q, c, a, drop);
}

}  // namespace

int orient3d_sign(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, const sim::Vec3& d) {
  const sim::Vec3 u = b - a, v = c - a, w = d - a;
  const double xy = u.x() * v.y(), yx = u.y() * v.x();
  const double yz = u.y() * v.z(), zy = u.z() * v.y();
  const double zx = u.z() * v.x(), xz = u.x() * v.z();
  const double det = (yz - zy) * w.x() + (zx - xz) * w.y() + (xy - yx) * w.z();
  const double permanent = (std::abs(yz) + std::abs(zy)) * std::abs(w.x()) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(w.y()) +
                           (std::abs(xy) + std::abs(yx)) * std::abs(w.z());
  // Shewchuk's o3derrboundA = (7 + 56 eps) eps with eps = 2^-53, rounded up.
  const double bound = 8e-16 * permanent;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  for (int axis = 0; axis < 3; ++axis)
    if (lie_in_an_axis_plane(axis, a, b, c) && a[axis] == d[axis]) return 0;
  return orient3d_exact(a, b, c, d);
}

int orient2d_sign(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, int drop) {
  const int i = (drop + 1) % 3, j = (drop + 2) % 3;
  const double left = (b[i] - a[i]) * (c[j] - a[j]), right = (b[j] - a[j]) * (c[i] - a[i]);
  const double bound = 4e-16 * (std::abs(left) + std::abs(right));  // ccwerrboundA = (3 + 16 eps) eps, rounded up
  if (left - right > bound) return 1;
  if (left - right < -bound) return -1;
  return sign(add(multiply(difference(b[i], a[i]), difference(c[j], a[j])),
                  negate(multiply(difference(b[j], a[j]), difference(c[i], a[i])))));
}

bool is_flat(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) { return visible_axis(a, b, c) < 0; }

bool triangles_cross(const std::vector<sim::Vec3>& vertices, const sim::Triangle& s, const sim::Triangle& t) {
  const auto at = [&](int v) -> const sim::Vec3& { return vertices[static_cast<std::size_t>(v)]; };
  // Turn both so that shared vertices come first.
  std::array<int, 3> sv = s, tv = t;
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = shared; j < 3; ++j) {
      if (sv[i] != tv[j]) continue;
      std::swap(sv[shared], sv[i]);
      std::swap(tv[shared], tv[j]);
      ++shared;
      break;
    }
  }
  const sim::Vec3 &a = at(sv[0]), &b = at(sv[1]), &c = at(sv[2]);
  const sim::Vec3 &d = at(tv[0]), &e = at(tv[1]), &f = at(tv[2]);
  switch (shared) {
    case 3:
      return true;
    case 2: {  // more than the common edge only when folded flat onto each other
      if (opens_wide(a, b, c, f)) return false;
      if (orient3d_sign(a, b, c, f) != 0) return false;
      const int drop = visible_axis(a, b, c);
      return orient2d_sign(a, b, c, drop) == orient2d_sign(a, b, f, drop);
    }
    case 1:  // a common set beyond the vertex leaves one of them through the edge opposite to it
      if (parted_at(a, b, c, e, f)) return false;
      return segment_meets_triangle(b, c, d, e, f) || segment_meets_triangle(e, f, a, b, c);
    default:
      if (parted(a, b, c, d, e, f)) return false;
      return segment_meets_triangle(a, b, d, e, f) || segment_meets_triangle(b, c, d, e, f) ||
             segment_meets_triangle(c, a, d, e, f) || segment_meets_triangle(d, e, a, b, c) ||
             segment_meets_triangle(e, f, a, b, c) || segment_meets_triangle(f, d, a, b, c);
  }
}

}  // namespace softreel::assets
