#pragma once
// Newton's method with backtracking for the incremental potential.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/incremental_potential.h"
#include "sim/linear_solver.h"

namespace softreel::sim {

struct NewtonSettings {
  double tolerance = 1e-3;  ///< relative to the motion that the step has to produce
  int max_iterations = 60;
  double linear_tolerance = 1e-3;  ///< of one iterative linear solve, relative
};

/// Minimizes Phi. Converged when for every body |g| <= max(tolerance |g0|, rounding), g0 the gradient at the start of
/// the solve and rounding = 16 eps |(M + beta H) |y||: relative to the forces that the step has to balance, so it holds
/// for stiff bodies too, where a step of 1e-6 m is the whole answer; the floor lets a body at rest converge at once.
class Newton {
 public:
  Newton(const Model& model, IncrementalPotential& phi, std::string_view linear_solver, const NewtonSettings& settings);

  /// `y`: the start, then the minimizer, 3n [m]. Sets converged, reason and the counts of `report`.
  void minimize(Eigen::VectorXd& y, StepReport& report);

  LinearSolver& linear_solver() { return *linear_; }
  /// Builds the pattern and the symbolic work before the first step needs it (a resumed run restores into it).
  void prepare();

 private:
  std::string direction(const Eigen::VectorXd& y, const std::vector<double>& targets, StepReport& report);
  std::vector<double> linear_targets(const std::vector<double>& target) const;
  std::string descend(Eigen::VectorXd& y, double rounding, StepReport& report);
  bool line_search(Eigen::VectorXd& y, double slope, double rounding, StepReport& report);

  const Model& model_;
  IncrementalPotential& phi_;
  NewtonSettings settings_;
  std::unique_ptr<LinearSolver> linear_;
  bool analysed_ = false;
  BlockMatrix H_;
  Eigen::VectorXd g_, model_gradient_, d_, trial_, trial_gradient_;
};

}  // namespace softreel::sim
