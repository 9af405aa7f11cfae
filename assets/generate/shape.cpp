#include "assets/generate/shape.h"

#include <algorithm>
#include <cmath>

namespace softreel::generate {

double sphere(const Vec3& p, const Vec3& center, double radius) { return (p - center).norm() - radius; }

double ellipsoid(const Vec3& p, const Vec3& center, const Vec3& radii) {
  const Vec3 q = p - center;
  const double k0 = q.cwiseQuotient(radii).norm();
  const double k1 = q.cwiseQuotient(radii.cwiseProduct(radii)).norm();
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

double round_cone(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (ra + t * (rb - ra));
}

double rounded_box(const Vec3& p, const Vec3& half, double radius) {
  const Vec3 q = p.cwiseAbs() - half + Vec3::Constant(radius);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
}

double torus(const Vec3& p, double radius, double tube) {
  return std::hypot(std::hypot(p.x(), p.z()) - radius, p.y()) - tube;
}

double smooth_union(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double smooth_intersection(double a, double b, double k) { return -smooth_union(-a, -b, k); }

Vec3 gradient(const Field& field, const Vec3& p) {
  constexpr double kStep = 1e-5;
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = kStep * Vec3::Unit(k);
    g[k] = (field(p + d) - field(p - d)) / (2 * kStep);
  }
  return g;
}

Vec3 project(const Field& field, Vec3 p) {
  for (int i = 0; i < 4; ++i) {
    const double value = field(p);
    const Vec3 g = gradient(field, p);
    const double slope = g.squaredNorm();
    if (slope < 1e-6) break;
    p -= g * std::clamp(value / slope, -0.02, 0.02);
  }
  return p;
}

}  // namespace softreel::generate
