#include <algorithm>
#include <array>
#include <cmath>

#include "assets/generate/models.h"

namespace softreel::generate {
namespace {

Vec3 mirrored(const Vec3& p) { return {std::abs(p.x()), p.y(), p.z()}; }

/// A Catmull-Rom curve through the bones: straight pieces would show at their joints.
double tail(const Vec3& p) {
  static const std::array<Eigen::Vector4d, 8> bones = {
      Eigen::Vector4d(0, 0.42, 0.05, 0.25),      Eigen::Vector4d(0, 0.27, -0.17, 0.20),
      Eigen::Vector4d(0, 0.16, -0.42, 0.15),     Eigen::Vector4d(0.03, 0.125, -0.63, 0.12),
      Eigen::Vector4d(0.09, 0.17, -0.79, 0.095), Eigen::Vector4d(0.14, 0.29, -0.88, 0.08),
      Eigen::Vector4d(0.16, 0.43, -0.87, 0.065), Eigen::Vector4d(0.17, 0.55, -0.84, 0.05)};
  constexpr int kPieces = 6;
  double d = 1e9;
  for (std::size_t i = 0; i + 3 < bones.size(); ++i) {
    Eigen::Vector4d last = bones[i + 1];
    for (int k = 1; k <= kPieces; ++k) {
      const double t = static_cast<double>(k) / kPieces;
      const Eigen::Vector4d next = 0.5 * (2 * bones[i + 1] + t * (bones[i + 2] - bones[i]) +
                                          t * t * (2 * bones[i] - 5 * bones[i + 1] + 4 * bones[i + 2] - bones[i + 3]) +
                                          t * t * t * (3 * bones[i + 1] - bones[i] - 3 * bones[i + 2] + bones[i + 3]));
      d = std::min(d, round_cone(p, last.head<3>(), next.head<3>(), last[3], next[3]));
      last = next;
    }
  }
  return d;
}

double horns(const Vec3& p) { return round_cone(mirrored(p), {0.15, 1.17, -0.02}, {0.215, 1.36, -0.09}, 0.07, 0.03); }

double ears(const Vec3& p) { return round_cone(mirrored(p), {0.30, 1.03, -0.04}, {0.50, 1.12, -0.13}, 0.085, 0.03); }

double spines(const Vec3& p) {
  double d = round_cone(p, {0, 1.20, -0.10}, {0, 1.31, -0.16}, 0.06, 0.025);
  d = std::min(d, round_cone(p, {0, 1.06, -0.25}, {0, 1.13, -0.37}, 0.07, 0.025));
  d = std::min(d, round_cone(p, {0, 0.80, -0.26}, {0, 0.85, -0.40}, 0.07, 0.025));
  d = std::min(d, round_cone(p, {0, 0.56, -0.31}, {0, 0.60, -0.46}, 0.075, 0.025));
  d = std::min(d, round_cone(p, {0, 0.34, -0.36}, {0, 0.42, -0.50}, 0.07, 0.025));
  return std::min(d, round_cone(p, {0.02, 0.22, -0.58}, {0.02, 0.33, -0.66}, 0.05, 0.025));
}

double tail_tip(const Vec3& p) { return ellipsoid(p, {0.165, 0.50, -0.865}, {0.105, 0.125, 0.07}); }

double toes(const Vec3& p) {
  const Vec3 m = mirrored(p);
  return std::min({sphere(m, {0.110, 0.06, 0.263}, 0.043), sphere(m, {0.20, 0.055, 0.292}, 0.045),
                   sphere(m, {0.288, 0.06, 0.258}, 0.043)});
}

double body(const Vec3& p) {
  const Vec3 m = mirrored(p);
  double d = ellipsoid(p, {0, 0.42, 0}, {0.345, 0.38, 0.31});
  d = smooth_union(d, ellipsoid(p, {0, 0.95, 0.02}, {0.36, 0.29, 0.31}), 0.14);
  d = smooth_union(d, ellipsoid(p, {0, 0.865, 0.27}, {0.20, 0.125, 0.13}), 0.08);
  d = smooth_union(d, sphere(m, {0.155, 1.0, 0.225}, 0.10), 0.03);
  d = smooth_union(d, ears(p), 0.06);
  d = smooth_union(d, horns(p), 0.03);
  d = smooth_union(d, round_cone(m, {0.28, 0.56, 0.10}, {0.36, 0.43, 0.29}, 0.10, 0.085), 0.05);
  d = smooth_union(d, ellipsoid(m, {0.20, 0.10, 0.10}, {0.155, 0.13, 0.22}), 0.06);
  d = smooth_union(d, toes(p), 0.02);
  d = smooth_union(d, tail(p), 0.10);
  d = smooth_union(d, tail_tip(p), 0.03);
  d = smooth_union(d, spines(p), 0.03);
  return smooth_intersection(d, -p.y(), 0.03);  // it stands on flat feet
}

/// An arc below the nose.
double mouth(const Vec3& p) {
  const Vec3 m = mirrored(p);
  const double along = std::hypot(m.x() - 0.05, m.y() - 0.845) - 0.05;
  return std::max({std::abs(along) - 0.009, m.y() - 0.845, 0.2 - p.z()});
}

double eyes(const Vec3& p) { return sphere(mirrored(p), {0.165, 1.0, 0.315}, 0.078); }

/// On the same side of both eyes: it is the light's.
double glints(const Vec3& p) {
  return std::min(sphere(p, {-0.145, 1.032, 0.335}, 0.027), sphere(p, {0.187, 1.032, 0.325}, 0.027));
}

double nostrils(const Vec3& p) { return sphere(mirrored(p), {0.065, 0.925, 0.385}, 0.021); }
double cheeks(const Vec3& p) { return ellipsoid(mirrored(p), {0.275, 0.87, 0.215}, {0.065, 0.05, 0.1}); }
double belly(const Vec3& p) { return ellipsoid(p, {0, 0.40, 0.32}, {0.235, 0.29, 0.25}); }

double edge_length(const Vec3& p) {
  const double fine =
      std::min({std::abs(glints(p)), std::abs(nostrils(p)), std::abs(mouth(p)), std::abs(toes(p)) + 0.02});
  const double medium = std::min({std::abs(eyes(p)), horns(p), spines(p), ears(p), std::abs(cheeks(p))});
  return std::min({0.062, 0.018 + 0.4 * std::max(0.0, fine), 0.036 + 0.35 * std::max(0.0, medium)});
}

}  // namespace

Model dragon() {
  const std::array<double, 3> cream = {0.87, 0.66, 0.33};
  return {"dragon",
          body,
          edge_length,
          {{"skin", {0.10, 0.47, 0.36}, 0.45, {}},
           {"belly", {0.80, 0.70, 0.38}, 0.5, belly},
           {"horns", cream, 0.4, [](const Vec3& p) { return horns(p) - 0.012; }},
           {"spines", {0.90, 0.32, 0.08}, 0.4, [](const Vec3& p) { return std::min(spines(p), tail_tip(p)) - 0.010; }},
           {"toes", cream, 0.4, [](const Vec3& p) { return toes(p) - 0.006; }},
           {"cheeks", {0.86, 0.24, 0.22}, 0.6, cheeks},
           {"eyes", {0.012, 0.010, 0.014}, 0.15, eyes},
           {"glints", {0.95, 0.95, 0.95}, 0.3, glints},
           {"nostrils", {0.03, 0.12, 0.09}, 0.6, nostrils},
           {"mouth", {0.03, 0.10, 0.08}, 0.6, mouth}},
          {-0.65, -0.1, -1.1},
          {0.65, 1.5, 0.6}};
}

}  // namespace softreel::generate
