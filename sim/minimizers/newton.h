#pragma once
// Newton's method for the incremental potential.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "sim/line_search.h"
#include "sim/linear_solver.h"
#include "sim/minimizer.h"

namespace softreel::sim {

/// Each iteration solves H d = -g and searches along d.
///
/// `hessian = "auto"`: exact where that is positive definite, else clamped ("projection on demand", Longva et al.
/// 2023): clamping costs the quadratic convergence, and is needed only far from a minimum. Solves that follow begin as
/// the last one ended. "clamped": every element's Hessian is made positive semi-definite by itself, which costs nothing
/// beside the element and seldom loses much. "shifted": the exact Hessian plus c I (Nocedal and Wright 2006,
/// section 3.4), c growing tenfold until the factorization succeeds and the search goes down, and falling again when it
/// does. The clamped one is shifted too where it is singular (a free body at rest, a slack sheet in equilibrium).
///
/// Where no Hessian ever changes (linear solids, gravity, drag), the matrix is assembled and factorized once for each
/// length of step, and its full step is the minimum: no search.
class Newton final : public Minimizer {
 public:
  static constexpr MethodInfo kInfo = {"newton", "few iterations at any stiffness",
                                       "1 Hessian and 1 linear solve an iteration",
                                       "Nocedal, Wright 2006, section 3.3"};

  Newton(const Model& model, IncrementalPotential& phi, const LinearSettings& linear_solver,
         const MinimizerSettings& settings);

  std::vector<double> memory() const override;
  void restore(std::span<const double> saved) override;

 private:
  Failure begin() override;
  Failure advance(int iteration, Eigen::VectorXd& y, StepReport& report) override;
  Failure drive(Eigen::VectorXd& y, StepReport& report) override;
  void end() override;
  std::string_view title() const override { return "Newton's method"; }

  void prepare();
  void assemble(const Eigen::VectorXd& y, StepReport& report);
  bool go_on(Eigen::VectorXd& y, StepReport& report);
  bool step(int iteration, Eigen::VectorXd& y, StepReport& report, std::string& failure);
  void clamp_for_a_while(int iteration, bool indefinite);
  bool shift_more();
  bool direction(const Eigen::VectorXd& y, StepReport& report, std::string& failure);
  std::vector<double> linear_targets() const;

  double linear_tolerance_;
  enum class Modification { kAuto, kClamped, kShifted } modification_;
  Definiteness definiteness_ = Definiteness::kClamped;
  int next_exact_ = 0;       // iteration at which kAuto tries the exact Hessian
  int mistrust_ = 0;         // so many solves more begin clamped with kAuto
  int next_mistrust_ = 0;    // and so many after the next exact Hessian that is indefinite: this twice, and one
  bool mistrusted_ = false;  // in this solve
  double forcing_ = 0;       // relative residual that this iteration's linear solve is worth
  double last_slope_ = 0;    // of the last step along d_, at its beginning; 0: it is not to be gone on with
  double last_length_ = 0;   // of that step, in d_
  double last_norm_ = 0;     // of the gradient, one iteration ago
  std::unique_ptr<LinearSolver> linear_;
  LineSearch search_;
  long analysed_ = -1;        // pattern that the linear solver has analysed
  double shift_ = 0;          // c, relative to the mean diagonal at rest; kept from step to step
  bool indefinite_ = false;   // why the last direction was not found
  double applied_shift_ = 0;  // what of it is in H_ [kg]
  const bool constant_;       // no Hessian of the model ever changes
  // Scales of the stage that H_ is of, 0 of all: of none.
  struct Scales {
    double inertia = 0, beta = 0, a = 0;
    bool operator==(const Scales&) const = default;
  } assembled_;
  bool factorized_ = false;  // the linear solver knows H_ as it is
  BlockMatrix H_;
  Eigen::VectorXd model_gradient_, d_;
};

}  // namespace softreel::sim
