#include "sim/cholesky_solver.h"

namespace softreel::sim {

LinearReport CholeskySolver::solve(const Eigen::VectorXd& b, const LinearTargets&, Eigen::VectorXd& x) {
  LinearReport report;
  report.chosen = "cholesky";
  factor_.solve(b, x, report);
  return report;
}

}  // namespace softreel::sim
