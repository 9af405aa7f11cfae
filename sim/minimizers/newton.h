#pragma once
// Newton's method for the incremental potential.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "sim/convergence_test.h"
#include "sim/line_search.h"
#include "sim/linear_solver.h"
#include "sim/minimizer.h"

namespace softreel::sim {

/// Each iteration solves H d = -g and searches along d.
///
/// `hessian = "auto"`: clamped at first, which is robust far from the minimum; after some iterations exact where that
/// is positive definite, because under load clamping costs the quadratic convergence ("projection on demand", Longva et
/// al. 2023). "clamped": every element's Hessian is made positive semi-definite by itself, which
/// costs nothing beside the element and seldom loses much. "shifted": the exact Hessian plus c I (Nocedal and Wright
/// 2006, section 3.4), c growing tenfold until the factorization succeeds and the search goes down, and falling again
/// when it does. The clamped one is shifted too where it is singular (a free body at rest, a slack sheet in
/// equilibrium).
class Newton final : public Minimizer {
 public:
  static constexpr MethodInfo kInfo = {"newton", "few iterations at any stiffness",
                                       "1 Hessian and 1 linear solve an iteration",
                                       "Nocedal, Wright 2006, section 3.3"};

  Newton(const Model& model, IncrementalPotential& phi, const LinearSettings& linear_solver,
         const MinimizerSettings& settings);

  void minimize(Eigen::VectorXd& y, StepReport& report) override;
  std::vector<double> memory() const override;
  void restore(std::span<const double> saved) override;

 private:
  void prepare();
  bool step(int iteration, Eigen::VectorXd& y, StepReport& report, std::string& failure);
  bool shift_more();
  bool direction(const Eigen::VectorXd& y, StepReport& report, std::string& failure);
  std::vector<double> linear_targets() const;

  const Model& model_;
  IncrementalPotential& phi_;
  MinimizerSettings settings_;
  enum class Modification { kAuto, kClamped, kShifted } modification_;
  Definiteness definiteness_ = Definiteness::kClamped;
  int next_exact_ = 0;  // iteration at which kAuto tries the exact Hessian
  std::unique_ptr<LinearSolver> linear_;
  ConvergenceTest test_;
  LineSearch search_;
  bool analysed_ = false;
  double shift_ = 0;          // c, relative to the mean diagonal at rest; kept from step to step
  bool indefinite_ = false;   // why the last direction was not found
  double applied_shift_ = 0;  // what of it is in H_ [kg]
  BlockMatrix H_;
  Eigen::VectorXd g_, model_gradient_, d_;
};

}  // namespace softreel::sim
