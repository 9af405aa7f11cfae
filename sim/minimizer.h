#pragma once
// Minimizers of the function of an implicit step.
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/catalogue.h"
#include "sim/convergence_test.h"
#include "sim/incremental_potential.h"
#include "sim/linear_solver.h"
#include "sim/minimizer_settings.h"

namespace softreel::sim {

/// Goes down from where a step starts to its minimum. The loop is here; a method is one iteration of it.
class Minimizer {
 public:
  /// `model` and `phi` must outlive this.
  Minimizer(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings);
  virtual ~Minimizer() = default;

  /// `y`: where bodies would be without forces, 3n [m]: what the solve's tolerance is relative to; then the minimizer.
  /// `guess`: a place that may be nearer to it, taken if forces are smaller there; may be null. Sets converged, reason,
  /// stopped_by and the counts of `report`.
  void minimize(Eigen::VectorXd& y, const Eigen::VectorXd* guess, StepReport& report);

  /// What later solves depend on beside the state; `restore` goes on from it with the same bits.
  virtual std::vector<double> memory() const { return {}; }
  virtual void restore(std::span<const double>) {}

 protected:
  /// Why the solve cannot go on, for the user, or nothing.
  using Failure = std::string;

  /// Before the first iteration of a solve.
  virtual Failure begin() { return {}; }
  /// One iteration from y, where the gradient is g_: moves y, shows test_ how it went, counts in `report`.
  virtual Failure advance(int iteration, Eigen::VectorXd& y, StepReport& report) = 0;
  /// One iteration that takes what is held the rest of its way (IncrementalPotential::driving), as `advance`.
  virtual Failure drive(Eigen::VectorXd& y, StepReport& report);
  /// After a solve that converged.
  virtual void end() {}
  /// What to tell instead of `failure`, that forces are not finite.
  virtual Failure not_finite(const Failure& failure) const { return failure; }
  /// Name of the method, as in "... did not converge"; what else to do when it is too slow.
  virtual std::string_view title() const = 0;
  virtual std::string_view advice() const { return {}; }

  const Model& model_;
  IncrementalPotential& phi_;
  ConvergenceTest test_;
  Eigen::VectorXd g_;

 private:
  void run(Eigen::VectorXd& y, const Eigen::VectorXd* guess, StepReport& report, Failure& failure);

  int max_iterations_;
  Eigen::VectorXd guess_gradient_;
};

/// `model` and `phi` must outlive the minimizer. Throws std::invalid_argument for unknown names and for settings that
/// do not go together.
std::unique_ptr<Minimizer> make_minimizer(const Model& model, IncrementalPotential& phi,
                                          const LinearSettings& linear_solver, const MinimizerSettings& settings);

}  // namespace softreel::sim
