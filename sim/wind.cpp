#include "sim/wind.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sim/element_term.h"

namespace softreel::sim {
namespace {

struct WindKernel {
  static constexpr int kCorners = 3;
  static constexpr bool kConstantHessian = false;

  struct Lagged {
    Vec3 normal = Vec3::Zero();
    Vec3 air = Vec3::Zero();  // [m/s]
    double area = 0;          // [m^2]
  };

  WindField field;
  double pressure;  // rho c [kg/m^3]
  double friction;  // rho c_f [kg/m^3]
  std::vector<std::uint8_t> closed;
  std::vector<Lagged> lagged;

  void begin_step(const StepContext& context, std::span<const int> stencils) {
    const double t = context.t_forces;
    parallel_for(static_cast<int>(lagged.size()), Work::kRow, [&](int e) {
      const int* corners = stencils.data() + 3 * static_cast<size_t>(e);
      const Vec3 a = context.x_predicted.segment<3>(3 * corners[0]), b = context.x_predicted.segment<3>(3 * corners[1]),
                 c = context.x_predicted.segment<3>(3 * corners[2]);
      Lagged& l = lagged[static_cast<size_t>(e)];
      const Vec3 doubled = (b - a).cross(c - a);
      const double length = doubled.norm();
      l.area = 0.5 * length;
      l.normal = length > 0 ? Vec3(doubled / length) : Vec3::Zero();
      l.air = field.velocity(t, (a + b + c) / 3);
    });
  }

  struct Relative {
    double normal;  // s [m/s]; 0 on the lee side of a solid
    Vec3 along;     // u_t [m/s]
  };
  Relative relative(int e, const Corners<3>& V) const {
    const Lagged& l = lagged[static_cast<size_t>(e)];
    const Vec3 u = l.air - V.rowwise().mean();
    const double s = u.dot(l.normal);
    const bool lee = closed[static_cast<size_t>(e)] && s > 0;
    return {lee ? 0.0 : s, friction > 0 ? Vec3(u - s * l.normal) : Vec3::Zero()};
  }

  double energy(int e, const Corners<3>& V) const {
    const Relative r = relative(e, V);
    const double s = std::abs(r.normal), u = r.along.norm();
    return lagged[static_cast<size_t>(e)].area / 6 * (pressure * s * s * s + friction * u * u * u);
  }

  void gradient(int e, const Corners<3>& V, Corners<3>& out) const {
    const Lagged& l = lagged[static_cast<size_t>(e)];
    const Relative r = relative(e, V);
    const Vec3 force =
        l.area / 2 * (pressure * std::abs(r.normal) * r.normal * l.normal + friction * r.along.norm() * r.along);
    out.colwise() = -force / 3;
  }

  void hessian(int e, const Corners<3>& V, Definiteness, ElementHessian<3>& out) const {
    const Lagged& l = lagged[static_cast<size_t>(e)];
    const Relative r = relative(e, V);
    const Eigen::Matrix3d nn = l.normal * l.normal.transpose();
    Eigen::Matrix3d K = pressure * std::abs(r.normal) * nn;
    const double speed = r.along.norm();
    if (speed > 0)
      K += friction / 2 * (speed * (Eigen::Matrix3d::Identity() - nn) + r.along * r.along.transpose() / speed);
    K *= l.area / 9;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) out.block<3, 3>(3 * a, 3 * b) = K;
  }
};

struct WindDragKernel {
  static constexpr int kCorners = 1;
  static constexpr bool kConstantHessian = true;
  WindField field;
  Eigen::VectorXd coefficient;  // mass times rate [kg/s]
  std::vector<Vec3> air;        // at each vertex [m/s]

  void begin_step(const StepContext& context, std::span<const int>) {
    parallel_for(static_cast<int>(air.size()), Work::kRow, [&](int i) {
      air[static_cast<size_t>(i)] = field.velocity(context.t_forces, Vec3(context.x_predicted.segment<3>(3 * i)));
    });
  }
  double energy(int e, const Corners<1>& v) const {
    return 0.5 * coefficient(e) * (v - air[static_cast<size_t>(e)]).squaredNorm();
  }
  void gradient(int e, const Corners<1>& v, Corners<1>& out) const {
    out = coefficient(e) * (v - air[static_cast<size_t>(e)]);
  }
  void hessian(int e, const Corners<1>&, Definiteness, ElementHessian<1>& out) const {
    out = coefficient(e) * Eigen::Matrix3d::Identity();
  }
};

}  // namespace

WindField::WindField(const Wind& wind)
    : mean_(wind.velocity), amplitude_(wind.gusts * wind.velocity.norm()), slowness_(0) {
  frequencies_.fill(0);
  if (amplitude_ <= 0) return;
  slowness_ = 1 / mean_.norm();
  axes_.col(0) = mean_ * slowness_;
  axes_.col(1) = axes_.col(0).unitOrthogonal();
  axes_.col(2) = axes_.col(0).cross(axes_.col(1));
  // Powers of the golden mean: no two have a rational ratio.
  double frequency = 2 * std::numbers::pi / wind.gust_period;
  for (double& f : frequencies_) {
    f = frequency;
    frequency *= std::numbers::phi;
  }
  // mt19937's numbers are fixed by the standard, its distributions are not.
  std::mt19937 random(static_cast<std::uint32_t>(wind.seed));
  for (auto& axis : phases_)
    for (double& phase : axis) phase = 2 * std::numbers::pi * static_cast<double>(random()) / 4294967296.0;
}

Vec3 WindField::velocity(double t, const Vec3& p) const {
  if (slowness_ <= 0) return mean_;
  const double since = t - slowness_ * axes_.col(0).dot(p);
  Vec3 gust = Vec3::Zero();
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t k = 0; k < kSines; ++k)
      gust(static_cast<Eigen::Index>(axis)) += std::sin(frequencies_[k] * since + phases_[axis][k]) / kSines;
  return mean_ + amplitude_ * (axes_ * gust);
}

std::unique_ptr<EnergyTerm> make_wind(const Wind& wind, const std::vector<WindSurface>& surfaces) {
  std::vector<int> stencils;
  std::vector<std::uint8_t> closed;
  for (const WindSurface& s : surfaces)
    for (const Triangle& t : s.triangles) {
      stencils.insert(stencils.end(), t.begin(), t.end());
      closed.push_back(s.closed);
    }
  WindKernel kernel{WindField(wind), wind.density * wind.drag, wind.density * wind.friction, std::move(closed), {}};
  kernel.lagged.resize(kernel.closed.size());
  return std::make_unique<ElementTerm<WindKernel>>("wind", EnergyKind::kDissipation, std::move(stencils),
                                                   std::move(kernel));
}

std::unique_ptr<EnergyTerm> make_wind_drag(const Wind& wind, const Eigen::VectorXd& masses, double rate) {
  std::vector<int> vertices(static_cast<size_t>(masses.size()));
  std::iota(vertices.begin(), vertices.end(), 0);
  WindDragKernel kernel{WindField(wind), rate * masses, std::vector<Vec3>(vertices.size(), wind.velocity)};
  return std::make_unique<ElementTerm<WindDragKernel>>("drag", EnergyKind::kDissipation, std::move(vertices),
                                                       std::move(kernel));
}

}  // namespace softreel::sim
