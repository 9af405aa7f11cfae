#pragma once
// How far to go along a direction.
#include <Eigen/Core>
#include <string>

#include "sim/incremental_potential.h"

namespace softreel::sim {

class LineSearch {
 public:
  /// `name`: of `line_searches()`:
  ///   backtracking: halves the step to Armijo's condition (Nocedal and Wright 2006, section 3.1);
  ///   exact: the minimum along the direction, by its derivative (Illinois' false position, Dowell and Jarratt 1971).
  /// Near the minimum the decrease drowns in the rounding of Phi; there the slope along the direction, which rounding
  /// spares, decides (approximate Wolfe condition, Hager and Zhang 2005, section 2).
  /// Throws std::invalid_argument for an unknown name.
  LineSearch(IncrementalPotential& phi, const std::string& name);

  /// y += s d with s <= first, for a slope g.d < 0; `rounding`: that of Phi's value. Returns s, 0 if no step lowers
  /// Phi. An exact search may go beyond `first`.
  double along(const Eigen::VectorXd& d, double slope, double rounding, double first, Eigen::VectorXd& y,
               StepReport& report);

 private:
  struct Start {
    double value, slope, rounding;
  };
  double backtrack(const Eigen::VectorXd& d, const Start& start, double first, Eigen::VectorXd& y, StepReport& report);
  double exact(const Eigen::VectorXd& d, const Start& start, double first, const Eigen::VectorXd& y,
               StepReport& report);
  bool acceptable(const Eigen::VectorXd& d, const Start& start, double step, StepReport& report);
  double slope_at(const Eigen::VectorXd& y, const Eigen::VectorXd& d, double step, StepReport& report);

  IncrementalPotential& phi_;
  bool exact_;
  Eigen::VectorXd trial_, trial_gradient_;
};

}  // namespace softreel::sim
