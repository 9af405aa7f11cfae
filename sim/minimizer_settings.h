#pragma once
#include <string>

namespace softreel::sim {

struct MinimizerSettings {
  double tolerance = 1e-3;  ///< relative to the motion that the step has to produce, see ConvergenceTest
  int max_iterations = 50;
  double linear_tolerance = 1e-4;            ///< the finest of an iterative linear solve, relative
  std::string method = "newton";             ///< of `minimizers()`
  std::string hessian = "auto";              ///< of `hessian_modifications()`
  std::string line_search = "backtracking";  ///< of `line_searches()`
  std::string stop = "residual";             ///< of `stopping_tests()`
};

}  // namespace softreel::sim
