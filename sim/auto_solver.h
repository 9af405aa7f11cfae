#pragma once
#include "sim/cholesky_solver.h"
#include "sim/conjugate_gradient_solver.h"

namespace softreel::sim {

/// Sparse Cholesky or conjugate gradients, whichever takes less counted work: never by the clock, so the choice is the
/// same in every run.
class AutoSolver final : public LinearSolver {
 public:
  void analyse(const BlockMatrix& A) override;
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  void expect_same_matrix() override { same_matrix_ = true; }
  std::size_t bytes() const override;
  std::vector<double> memory() const override;
  void restore(std::span<const double> saved) override;

 private:
  void analyse_factor();
  double cholesky_work();
  double iteration_work() const;
  long affordable();
  LinearReport iterate(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x);
  LinearReport factor(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x);
  void judge(const LinearReport& report);

  const BlockMatrix* A_ = nullptr;
  CholeskySolver cholesky_;
  ConjugateGradientSolver cg_;
  bool current_ = false;                         // the factor is analysed for the pattern of A_
  bool factored_ = false, conditioned_ = false;  // A_ is as cholesky_, cg_ know it
  double work_ = 0;                              // of a factorization, as counted when it was last looked at; 0: never
  bool same_matrix_ = false;                     // it is factorized once for many solves
  bool direct_ = false;                          // iterations are too expensive at present
  long direct_solves_ = 0;                       // since they were last tried
  long pause_ = 0;                               // direct ones until they are tried again
  double mean_ = 0;                              // iterations of a solve, the latest weighing most
};

}  // namespace softreel::sim
