#include "sim/load.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace softreel::sim {
namespace {

class Load final : public EnergyTerm {
 public:
  Load(NodalForces forces, const LoadTimes& times)
      : vertices_(std::move(forces.vertices)), forces_(std::move(forces.forces)), times_(times), share_(times.at(0)) {}

  std::string_view name() const override { return "load"; }
  EnergyKind kind() const override { return EnergyKind::kGravity; }

  void begin_step(const StepContext& context) override {
    share_ = context.load_factor * times_.mean(context.t_forces - context.h / 2, context.h);
  }

  double value(const Eigen::VectorXd& x) const override {
    double sum = 0;
    for (size_t i = 0; i < vertices_.size(); ++i) sum += forces_[i].dot(x.segment<3>(3 * vertices_[i]));
    return -share_ * sum;
  }
  void add_gradient(const Eigen::VectorXd&, Eigen::VectorXd& gradient) const override {
    for (size_t i = 0; i < vertices_.size(); ++i) gradient.segment<3>(3 * vertices_[i]) -= share_ * forces_[i];
  }

 private:
  std::vector<int> vertices_;
  std::vector<Vec3> forces_;  // [N]
  LoadTimes times_;
  double share_;
};

}  // namespace

double LoadTimes::at(double t) const {
  if ((t < from && !always()) || t >= until) return 0;
  return ramp > 0 ? std::min((t - from) / ramp, 1.0) : 1.0;
}

double LoadTimes::mean(double t, double h) const {
  if (!(h > 0)) return at(t);
  // Integral of the share from `from` to s, without the end.
  const auto integral = [&](double s) {
    const double since = (always() ? std::min(s, until) : std::clamp(s, from, until)) - from;
    return always() ? since : since < ramp ? since * since / (2 * ramp) : since - ramp / 2;
  };
  return (integral(t + h) - integral(t)) / h;
}

NodalForces share_force(const Vec3& total, std::span<const int> vertices, const Eigen::VectorXd& masses) {
  double mass = 0;
  for (int v : vertices) mass += masses(v);
  NodalForces result;
  for (int v : vertices) {
    result.vertices.push_back(v);
    result.forces.push_back(masses(v) / mass * total);
  }
  return result;
}

NodalForces share_traction(const Vec3& traction, std::span<const Triangle> triangles, const Eigen::VectorXd& x) {
  std::map<int, double> areas;  // a third of the adjacent triangles'
  for (const Triangle& t : triangles) {
    const Vec3 a = x.segment<3>(3 * t[0]), b = x.segment<3>(3 * t[1]), c = x.segment<3>(3 * t[2]);
    const double third = (b - a).cross(c - a).norm() / 6;
    for (int v : t) areas[v] += third;
  }
  NodalForces result;
  for (const auto& [v, area] : areas) {
    result.vertices.push_back(v);
    result.forces.push_back(area * traction);
  }
  return result;
}

std::unique_ptr<EnergyTerm> make_load(NodalForces forces, const LoadTimes& times) {
  return std::make_unique<Load>(std::move(forces), times);
}

}  // namespace softreel::sim
