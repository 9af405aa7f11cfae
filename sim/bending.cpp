#include "sim/bending.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "sim/element_term.h"
#include "sim/mesh_topology.h"

// Both energies are calibrated so that a sheet bent to curvature kappa stores k/2 kappa^2 per area: summed over the
// hinges of a regular mesh, |e|^2 theta^2/(A_0 + A_1) is the integral of kappa^2 (equilateral meshes: in every
// direction). The factor 3 of the two papers triples it: it comes from a nonconforming element whose hinges own a
// third of the area each (Wardetzky et al. 2007).

namespace softreel::sim {
namespace {

struct HingeShape {
  std::array<Vec3, 4> corner;  // a, b, opposite left, opposite right
  double area_sum;             // [m^2]
};

HingeShape shape_of(const TriangleMesh& rest, const Hinge& h) {
  const auto at = [&](int v) { return rest.vertices[static_cast<size_t>(v)]; };
  HingeShape s{{at(h.a), at(h.b), at(h.opposite_left), at(h.opposite_right)}, 0};
  const Vec3 e = s.corner[1] - s.corner[0];
  s.area_sum = 0.5 * (e.cross(s.corner[2] - s.corner[0]).norm() + e.cross(s.corner[3] - s.corner[0]).norm());
  return s;
}

/// Signed angle between the two normals, 0 when flat, and the normals themselves (lengths: twice the areas).
struct Dihedral {
  Vec3 e, p_left, p_right;  // edge a -> b; opposite corners from a
  Vec3 n_left, n_right;
  double theta;

  explicit Dihedral(const Corners<4>& X)
      : e(X.col(1) - X.col(0)),
        p_left(X.col(2) - X.col(0)),
        p_right(X.col(3) - X.col(0)),
        n_left(e.cross(p_left)),
        n_right(p_right.cross(e)) {
    const double length = e.norm();
    theta = length > 0 ? std::atan2(n_left.cross(n_right).dot(e) / length, n_left.dot(n_right)) : 0.0;
  }
  bool degenerate() const { return !(e.squaredNorm() > 0 && n_left.squaredNorm() > 0 && n_right.squaredNorm() > 0); }
};

struct QuadraticBendingKernel {
  static constexpr int kCorners = 4;
  static constexpr bool kConstantHessian = true;
  std::vector<Eigen::Vector4d> rows;  // sqrt(k / (A_0 + A_1)) L

  double energy(int e, const Corners<4>& X) const { return 0.5 * (X * rows[static_cast<size_t>(e)]).squaredNorm(); }
  void gradient(int e, const Corners<4>& X, Corners<4>& out) const {
    const Eigen::Vector4d& L = rows[static_cast<size_t>(e)];
    out = (X * L) * L.transpose();
  }
  void hessian(int e, const Corners<4>&, Definiteness, ElementHessian<4>& out) const {
    const Eigen::Vector4d& L = rows[static_cast<size_t>(e)];
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) out.block<3, 3>(3 * a, 3 * b) = L(a) * L(b) * Eigen::Matrix3d::Identity();
  }
};

using Jacobian = Eigen::Matrix<double, 3, 12>;

Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

struct DiscreteShellKernel {
  static constexpr int kCorners = 4;
  static constexpr bool kConstantHessian = false;
  struct Rest {
    double stiffness;  // k |e|^2/(A_0 + A_1) [J]
    double theta;      // rest angle [rad]
  };
  std::vector<Rest> rest;

  double energy(int e, const Corners<4>& X) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const double bend = wrapped(Dihedral(X).theta - r.theta);
    return 0.5 * r.stiffness * bend * bend;
  }

  void gradient(int e, const Corners<4>& X, Corners<4>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const Dihedral d(X);
    out.setZero();
    if (d.degenerate()) return;  // no plane, no angle
    out = r.stiffness * wrapped(d.theta - r.theta) * angle_gradient(d);
  }

  void hessian(int e, const Corners<4>& X, Definiteness definiteness, ElementHessian<4>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const Dihedral d(X);
    out.setZero();
    if (d.degenerate()) return;
    const Corners<4> g = angle_gradient(d);
    const Eigen::Map<const Eigen::Matrix<double, 12, 1>> flat(g.data());
    out = r.stiffness * (flat * flat.transpose() + wrapped(d.theta - r.theta) * angle_hessian(d, g));
    if (definiteness == Definiteness::kClamped) clamp_to_semidefinite<12>(out);
  }

 private:
  /// A hinge that folds past 180 degrees goes on, instead of jumping by a full turn.
  static double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

  static Corners<4> angle_gradient(const Dihedral& d) {
    const double length = d.e.norm();
    const double s_left = d.p_left.dot(d.e) / (length * length);
    const double s_right = d.p_right.dot(d.e) / (length * length);
    Corners<4> g;
    g.col(2) = -length / d.n_left.squaredNorm() * d.n_left;
    g.col(3) = -length / d.n_right.squaredNorm() * d.n_right;
    g.col(0) = -(1 - s_left) * g.col(2) - (1 - s_right) * g.col(3);
    g.col(1) = -s_left * g.col(2) - s_right * g.col(3);
    return g;
  }

  /// d angle_gradient / dX, by the chain rule through e, p and n of each side.
  static ElementHessian<4> angle_hessian(const Dihedral& d, const Corners<4>& g) {
    const double length = d.e.norm(), squared = length * length;
    Jacobian de = Jacobian::Zero();
    de.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
    de.block<3, 3>(0, 3) = Eigen::Matrix3d::Identity();
    const auto side = [&](const Vec3& p, const Vec3& n, int corner, double sign, Jacobian& dg,
                          Eigen::Matrix<double, 1, 12>& ds) {
      Jacobian dp = Jacobian::Zero();
      dp.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
      dp.block<3, 3>(0, 3 * corner) = Eigen::Matrix3d::Identity();
      const Jacobian dn = sign * (cross_matrix(d.e) * dp - cross_matrix(p) * de);  // n = sign e x p
      const double n2 = n.squaredNorm();
      dg = -(n / n2) * (d.e.transpose() / length) * de -
           length / n2 * (Eigen::Matrix3d::Identity() - 2.0 / n2 * n * n.transpose()) * dn;
      const double s = p.dot(d.e) / squared;
      ds = (d.e.transpose() * dp + p.transpose() * de - 2 * s * d.e.transpose() * de) / squared;
      return s;
    };
    Jacobian dg_left, dg_right;
    Eigen::Matrix<double, 1, 12> ds_left, ds_right;
    const double s_left = side(d.p_left, d.n_left, 2, 1.0, dg_left, ds_left);
    const double s_right = side(d.p_right, d.n_right, 3, -1.0, dg_right, ds_right);
    ElementHessian<4> H;
    H.middleRows<3>(0) = g.col(2) * ds_left - (1 - s_left) * dg_left + g.col(3) * ds_right - (1 - s_right) * dg_right;
    H.middleRows<3>(3) = -g.col(2) * ds_left - s_left * dg_left - g.col(3) * ds_right - s_right * dg_right;
    H.middleRows<3>(6) = dg_left;
    H.middleRows<3>(9) = dg_right;
    return 0.5 * (H + H.transpose());
  }
};

std::vector<int> corners_of(const std::vector<Hinge>& all, int first_vertex) {
  std::vector<int> stencils;
  stencils.reserve(all.size() * 4);
  for (const Hinge& h : all)
    for (int v : {h.a, h.b, h.opposite_left, h.opposite_right}) stencils.push_back(first_vertex + v);
  return stencils;
}

Corners<4> corners(const HingeShape& s) {
  Corners<4> X;
  for (int a = 0; a < 4; ++a) X.col(a) = s.corner[static_cast<size_t>(a)];
  return X;
}

}  // namespace

std::unique_ptr<EnergyTerm> make_quadratic_bending(const TriangleMesh& rest, double stiffness, int first_vertex) {
  const std::vector<Hinge> all = hinges(rest);
  QuadraticBendingKernel kernel;
  kernel.rows.reserve(all.size());
  for (const Hinge& h : all) {
    const HingeShape s = shape_of(rest, h);
    const auto cotangent = [&](int at, int b, int c) {
      const Vec3 u = s.corner[static_cast<size_t>(b)] - s.corner[static_cast<size_t>(at)];
      const Vec3 w = s.corner[static_cast<size_t>(c)] - s.corner[static_cast<size_t>(at)];
      return u.dot(w) / u.cross(w).norm();
    };
    // |e| times the jump of the derivative across the edge, exact for linear functions on the two triangles.
    const double a_left = cotangent(0, 1, 2), b_left = cotangent(1, 0, 2);
    const double a_right = cotangent(0, 1, 3), b_right = cotangent(1, 0, 3);
    const Eigen::Vector4d L(b_left + b_right, a_left + a_right, -(a_left + b_left), -(a_right + b_right));
    kernel.rows.push_back(std::sqrt(stiffness / s.area_sum) * L);
  }
  return std::make_unique<ElementTerm<QuadraticBendingKernel>>("bending", EnergyKind::kElastic,
                                                               corners_of(all, first_vertex), std::move(kernel));
}

std::unique_ptr<EnergyTerm> make_discrete_shell_bending(const TriangleMesh& rest, double stiffness, int first_vertex) {
  const std::vector<Hinge> all = hinges(rest);
  DiscreteShellKernel kernel;
  kernel.rest.reserve(all.size());
  for (const Hinge& h : all) {
    const HingeShape s = shape_of(rest, h);
    const Dihedral d(corners(s));
    kernel.rest.push_back({stiffness * d.e.squaredNorm() / s.area_sum, d.theta});
  }
  return std::make_unique<ElementTerm<DiscreteShellKernel>>("bending", EnergyKind::kElastic,
                                                            corners_of(all, first_vertex), std::move(kernel));
}

bool is_flat(const TriangleMesh& rest) {
  for (const Hinge& h : hinges(rest))
    if (std::abs(Dihedral(corners(shape_of(rest, h))).theta) > 1e-6) return false;
  return true;
}

}  // namespace softreel::sim
