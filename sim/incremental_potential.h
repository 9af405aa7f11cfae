#pragma once
// The function that an implicit step minimizes: Phi(y) = inertia/2 |y - y_tilde|_M^2 + beta (E(y) + D(a y + b)/a).
#include <Eigen/Core>
#include <vector>

#include "sim/hessian_assembler.h"
#include "sim/implicit_method.h"
#include "sim/mass.h"
#include "sim/model.h"
#include "sim/step_report.h"

namespace softreel::sim {

class IncrementalPotential {
 public:
  /// Builds the sparsity pattern. `model` and `pins` must outlive this.
  IncrementalPotential(const Model& model, const Pins& pins);

  Stage& stage() { return stage_; }
  const Stage& stage() const { return stage_; }
  MassMatrix& mass() { return mass_; }

  double value(const Eigen::VectorXd& y, StepReport& report);  ///< [J s^2]

  /// g = dPhi/dy, 3n [kg m]; zero where held.
  void gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g, StepReport& report);

  /// Hessian [kg], of elements as `definiteness` says; identity where held.
  void hessian(const Eigen::VectorXd& y, Definiteness definiteness, BlockMatrix& H, StepReport& report);

  /// Offers the step dy from y to all terms; true if some have changed their Hessians because of it.
  bool harden(const Eigen::VectorXd& y, const Eigen::VectorXd& dy);
  /// g += what the gradient of the changed model has over the true one; zero where held.
  void add_hardened_gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g);
  /// Takes such changes back.
  void soften();

  /// Largest step along dy that no term forbids, in (0, 1].
  double max_step(const Eigen::VectorXd& y, const Eigen::VectorXd& dy) const;

  /// 3n flags of what pins hold.
  const std::vector<std::uint8_t>& held() const { return pins_.fixed(); }

  /// Per vertex, the largest diagonal entry of the Hessian of E at the start [N/m]: the scale of rounding in forces.
  const Eigen::VectorXd& stiffness() const { return stiffness_; }

 private:
  bool damped() const;
  void set_velocity(const Eigen::VectorXd& y);

  const Model& model_;
  const Pins& pins_;
  MassMatrix mass_;
  HessianAssembler assembler_;
  Stage stage_;
  Eigen::VectorXd velocity_, offset_, stiffness_;
};

}  // namespace softreel::sim
