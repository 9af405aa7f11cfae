#include "sim/gravity.h"

#include "sim/parallel.h"

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

}  // namespace

std::unique_ptr<EnergyTerm> make_gravity(const Eigen::VectorXd& masses, const Eigen::Vector3d& gravity) {
  return std::make_unique<Gravity>(masses, gravity);
}

}  // namespace softreel::sim
