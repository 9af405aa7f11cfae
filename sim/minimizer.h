#pragma once
// Minimizers of the function of an implicit step.
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/catalogue.h"
#include "sim/incremental_potential.h"
#include "sim/linear_solver.h"

namespace softreel::sim {

struct MinimizerSettings {
  double tolerance = 1e-3;  ///< relative to the motion that the step has to produce, see ConvergenceTest
  int max_iterations = 50;
  double linear_tolerance = 1e-4;            ///< of one iterative linear solve, relative
  std::string method = "newton";             ///< of `minimizers()`
  std::string hessian = "auto";              ///< of `hessian_modifications()`
  std::string line_search = "backtracking";  ///< of `line_searches()`
  std::string stop = "residual";             ///< of `stopping_tests()`
};

class Minimizer {
 public:
  virtual ~Minimizer() = default;

  /// `y`: the start, then the minimizer, 3n [m]. Sets converged, reason, stopped_by and the counts of `report`.
  virtual void minimize(Eigen::VectorXd& y, StepReport& report) = 0;

  /// What later solves depend on beside the state; `restore` goes on from it with the same bits.
  virtual std::vector<double> memory() const { return {}; }
  virtual void restore(std::span<const double>) {}
};

/// `model` and `phi` must outlive the minimizer. Throws std::invalid_argument for unknown names and for settings that
/// do not go together.
std::unique_ptr<Minimizer> make_minimizer(const Model& model, IncrementalPotential& phi,
                                          const LinearSettings& linear_solver, const MinimizerSettings& settings);

}  // namespace softreel::sim
