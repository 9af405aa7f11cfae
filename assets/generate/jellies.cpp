#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/generate/models.h"

namespace softreel::generate {
namespace {

Field constant(double length) {
  return [length](const Vec3&) { return length; };
}

double star(const Vec3& p) {
  double d = ellipsoid(p, {0, 0, 0}, {0.24, 0.24, 0.17});
  for (int i = 0; i < 5; ++i) {
    const double angle = std::numbers::pi * (0.5 + 0.4 * i);
    const Vec3 tip(0.42 * std::cos(angle), 0.42 * std::sin(angle), 0);
    d = smooth_union(d, round_cone(p, {0, 0, 0}, tip, 0.17, 0.075), 0.08);
  }
  return d;
}

double bear(const Vec3& p) {
  const Vec3 m(std::abs(p.x()), p.y(), p.z());
  double d = ellipsoid(p, {0, 0.40, 0}, {0.23, 0.30, 0.20});
  d = smooth_union(d, ellipsoid(p, {0, 0.76, 0.02}, {0.20, 0.185, 0.18}), 0.06);
  d = smooth_union(d, ellipsoid(p, {0, 0.72, 0.17}, {0.09, 0.075, 0.08}), 0.04);
  d = smooth_union(d, sphere(m, {0.15, 0.92, 0.0}, 0.075), 0.04);
  d = smooth_union(d, round_cone(m, {0.17, 0.50, 0.08}, {0.17, 0.42, 0.25}, 0.085, 0.075), 0.04);
  d = smooth_union(d, round_cone(m, {0.15, 0.14, 0.04}, {0.16, 0.12, 0.24}, 0.125, 0.10), 0.05);
  d = smooth_union(d, sphere(p, {0, 0.22, -0.20}, 0.065), 0.03);
  return smooth_intersection(d, -p.y(), 0.05);
}

/// Eyes and nose.
double bear_face(const Vec3& p) {
  const Vec3 m(std::abs(p.x()), p.y(), p.z());
  return std::min(sphere(m, {0.083, 0.805, 0.18}, 0.036), ellipsoid(p, {0, 0.75, 0.25}, {0.042, 0.03, 0.05}));
}

}  // namespace

Model jelly_cube() {
  return {"jelly_cube",         [](const Vec3& p) { return rounded_box(p, Vec3::Constant(0.5), 0.14); },
          constant(0.08),       {{"jelly", {0.80, 0.05, 0.09}, 0.2, {}}},
          Vec3::Constant(-0.6), Vec3::Constant(0.6)};
}

Model jelly_star() {
  return {"jelly_star",       star, constant(0.05), {{"jelly", {0.95, 0.55, 0.03}, 0.2, {}}}, Vec3::Constant(-0.6),
          Vec3::Constant(0.6)};
}

Model jelly_ring() {
  return {"jelly_ring",       [](const Vec3& p) { return torus(p, 0.34, 0.16); },
          constant(0.065),    {{"jelly", {0.30, 0.10, 0.75}, 0.2, {}}},
          {-0.6, -0.3, -0.6}, {0.6, 0.3, 0.6}};
}

Model jelly_bear() {
  return {"jelly_bear",
          bear,
          [](const Vec3& p) { return std::min(0.052, 0.024 + 0.5 * std::abs(bear_face(p))); },
          {{"jelly", {0.08, 0.60, 0.12}, 0.2, {}}, {"face", {0.012, 0.03, 0.012}, 0.2, bear_face}},
          {-0.5, -0.1, -0.5},
          {0.5, 1.1, 0.6}};
}

}  // namespace softreel::generate
