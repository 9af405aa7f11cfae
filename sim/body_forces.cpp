#include "sim/body_forces.h"

#include <numeric>

#include "sim/element_term.h"

namespace softreel::sim {
namespace {

class Gravity final : public EnergyTerm {
 public:
  Gravity(const Eigen::VectorXd& masses, const Eigen::Vector3d& gravity) : weight_(3 * masses.size()) {
    for (Eigen::Index i = 0; i < masses.size(); ++i) weight_.segment<3>(3 * i) = masses(i) * gravity;
  }
  std::string_view name() const override { return "gravity"; }
  EnergyKind kind() const override { return EnergyKind::kGravity; }
  void begin_step(const StepContext& context) override { factor_ = context.load_factor; }
  double value(const Eigen::VectorXd& x) const override {
    return -factor_ * parallel_sum(static_cast<int>(x.size()), Work::kVector, [&](int i) { return weight_(i) * x(i); });
  }
  void add_gradient(const Eigen::VectorXd&, Eigen::VectorXd& gradient) const override { gradient -= factor_ * weight_; }

 private:
  Eigen::VectorXd weight_;  // [N]
  double factor_ = 1;
};

struct DragKernel {
  static constexpr int kCorners = 1;
  static constexpr bool kConstantHessian = true;
  Eigen::VectorXd coefficient;  // mass times rate [kg/s]

  double energy(int e, const Corners<1>& v) const { return 0.5 * coefficient(e) * v.squaredNorm(); }
  void gradient(int e, const Corners<1>& v, Corners<1>& out) const { out = coefficient(e) * v; }
  void hessian(int e, const Corners<1>&, Definiteness, ElementHessian<1>& out) const {
    out = coefficient(e) * Eigen::Matrix3d::Identity();
  }
};

}  // namespace

std::unique_ptr<EnergyTerm> make_gravity(const Eigen::VectorXd& masses, const Eigen::Vector3d& gravity) {
  return std::make_unique<Gravity>(masses, gravity);
}

std::unique_ptr<EnergyTerm> make_drag(const Eigen::VectorXd& masses, double rate) {
  std::vector<int> vertices(static_cast<size_t>(masses.size()));
  std::iota(vertices.begin(), vertices.end(), 0);
  return std::make_unique<ElementTerm<DragKernel>>("drag", EnergyKind::kDissipation, std::move(vertices),
                                                   DragKernel{rate * masses});
}

}  // namespace softreel::sim
