#pragma once
// The function that an implicit step minimizes: Phi(y) = inertia/2 |y - y_tilde|_M^2 + beta (E(y) + D(a y + b)/a).
#include <Eigen/Core>
#include <vector>

#include "sim/changing_blocks.h"
#include "sim/hessian_assembler.h"
#include "sim/implicit_method.h"
#include "sim/mass.h"
#include "sim/model.h"
#include "sim/step_report.h"
#include "sim/term_list.h"

namespace softreel::sim {

class IncrementalPotential {
 public:
  /// Of the `terms` of the model; builds the sparsity pattern. `model` and `pins` must outlive this.
  IncrementalPotential(const Model& model, const Pins& pins, TermList terms);

  /// Before each solve.
  void begin() {
    changing_.begin();
    short_steps_ = 0;
  }
  Stage& stage() { return stage_; }
  const Stage& stage() const { return stage_; }
  MassMatrix& mass() { return mass_; }

  double value(const Eigen::VectorXd& y, StepReport& report);  ///< [J s^2]

  /// g = dPhi/dy, 3n [kg m]; zero where held.
  void gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g, StepReport& report);

  /// Hessian [kg], of elements as `definiteness` says; identity where held. Its pattern changes with contact between
  /// surfaces.
  void hessian(const Eigen::VectorXd& y, Definiteness definiteness, BlockMatrix& H, StepReport& report);

  /// Offers the step dy from y to all terms; true if some have changed their Hessians because of it. H, which `hessian`
  /// gave at y for this definiteness, follows.
  bool harden(const Eigen::VectorXd& y, const Eigen::VectorXd& dy, Definiteness definiteness, BlockMatrix& H,
              StepReport& report);
  /// g += what the gradient of the changed model has over the true one; zero where held.
  void add_hardened_gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g);
  /// Takes such changes back.
  void soften();

  /// Largest step along dy on which nothing passes through, in [0, 1].
  double max_step(const Eigen::VectorXd& y, const Eigen::VectorXd& dy, StepReport& report);

  /// What is held or scripted has gone only `progress` of its way to `target` (3n, read where held), because something
  /// stood in it: a minimizer takes it the rest of the way, together with what it pushes.
  void drive_to(const Eigen::VectorXd& target, double progress);
  /// Is there a rest of the way?
  bool driving() const { return progress_ < 1; }
  /// Takes everything a share of the step d along, which `add_remaining` has completed.
  void driven(double share);
  /// d of what is held := the rest of its way from y.
  void set_remaining(const Eigen::VectorXd& y, Eigen::VectorXd& d) const;
  /// force := the change of the gradient at y when what is held and scripted goes the rest of its way; zero where held.
  void driven_force(const Eigen::VectorXd& y, Eigen::VectorXd& force, StepReport& report);
  /// Have many steps in a row been cut to next to nothing?
  bool blocked() const { return short_steps_ >= kMostShortSteps; }
  /// Was the last step that was cut, cut by an analytic collider?
  bool collider_blocks() const { return collider_blocks_; }

  /// 3n flags of what pins hold.
  const std::vector<std::uint8_t>& held() const { return pins_.fixed(); }

  /// Per vertex, the largest diagonal entry of the Hessian of E at the start [N/m]: the scale of rounding in forces.
  const Eigen::VectorXd& stiffness() const { return stiffness_; }

 private:
  bool damped() const;
  void assemble(const Eigen::VectorXd& y, Definiteness definiteness, const std::vector<std::uint8_t>& held,
                BlockMatrix& H);
  void set_velocity(const Eigen::VectorXd& y);

  const Model& model_;
  const Pins& pins_;
  TermList terms_;
  MassMatrix mass_;
  HessianAssembler assembler_;
  BlockMatrix fixed_part_;  // with changing stencils: what the others give
  ChangingBlocks changing_;
  Stage stage_;
  Eigen::VectorXd velocity_, offset_, stiffness_, target_;
  double progress_ = 1;
  static constexpr int kMostShortSteps = 3;
  static constexpr double kShortStep = 0.05;
  int short_steps_ = 0;
  bool collider_blocks_ = false;
};

}  // namespace softreel::sim
