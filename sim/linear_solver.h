#pragma once
// Linear systems A x = b with A symmetric positive definite: analyse / factorize / solve.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/block_matrix.h"
#include "sim/catalogue.h"
#include "sim/state.h"

namespace softreel::sim {

/// How far a solve has to go: |(b - A x)_body| <= target, for every body by itself, so that a light cloth beside a
/// heavy solid gets its own accuracy. Direct solvers ignore it.
struct LinearTargets {
  std::span<const BodyRange> bodies;
  std::span<const double> residual;            ///< one per body, in the unit of b
  const Eigen::VectorXd* positions = nullptr;  ///< 3n [m]: what the rigid modes of the bodies are made of; may be null
  const std::vector<std::uint8_t>* held =
      nullptr;  ///< 3n flags: rows of the identity, which no mode may move; may be null
};

struct LinearReport {
  bool ok = false;
  std::string reason;       ///< why not, if not ok
  bool indefinite = false;  ///< not ok because A is not positive definite
  long iterations = 0;      ///< 0 for a direct solver
  std::string_view chosen;  ///< the method that gave the answer
};

class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Symbolic work for the sparsity pattern; again only when the pattern changes.
  virtual void analyse(const BlockMatrix& A) = 0;
  /// Numeric work for the values; `A` must stay until the last solve with it.
  virtual void factorize(const BlockMatrix& A) = 0;
  /// x is written, not read.
  virtual LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) = 0;

  /// What later choices depend on; saved with a simulation, so that one that is resumed makes the same choices.
  virtual std::vector<double> memory() const { return {}; }
  virtual void restore(std::span<const double>) {}
};

/// Supernodal sparse Cholesky of CHOLMOD (Chen, Davis et al. 2008) after a nested-dissection order of the blocks.
class CholeskySolver final : public LinearSolver {
 public:
  CholeskySolver();
  ~CholeskySolver() override;
  void analyse(const BlockMatrix& A) override;
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;

  /// Floating-point operations of one factorization, nonzeros of the factor; counted by analyse.
  double factor_flops() const;
  double factor_nonzeros() const;
  bool analysed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Conjugate gradients with a 3x3 block-Jacobi preconditioner.
///
/// The residual of a stiff body is all strain: stopped at a thousandth of it, the rigid motion, whose forces are small,
/// could still be wrong altogether. So the solve ends with a projection onto the six rigid modes of every body (as far
/// as `positions` are given): their part of the error is gone, momentum is kept as a direct solver keeps it.
class ConjugateGradientSolver final : public LinearSolver {
 public:
  void analyse(const BlockMatrix&) override {}
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;

  /// Gives up after so many iterations; 0: after 10 times the number of unknowns (at least 1000).
  void set_max_iterations(long n) { max_iterations_ = n; }

 private:
  void correct_rigid_modes(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x);

  const BlockMatrix* A_ = nullptr;
  std::vector<double> inverse_diagonal_;  // 9 doubles per block
  long max_iterations_ = 0;
  Eigen::VectorXd r_, z_, p_, Ap_;
};

/// Sparse Cholesky or conjugate gradients, whichever takes less counted work: never by the clock, so the choice is the
/// same in every run.
class AutoSolver final : public LinearSolver {
 public:
  void analyse(const BlockMatrix& A) override;
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::vector<double> memory() const override;
  void restore(std::span<const double> saved) override;

 private:
  double cholesky_work();
  double iteration_work() const;

  const BlockMatrix* A_ = nullptr;
  CholeskySolver cholesky_;
  ConjugateGradientSolver cg_;
  bool direct_ = true;     // the current choice
  long since_choice_ = 0;  // solves since it was last put to the test
};

/// Throws std::invalid_argument for an unknown name.
std::unique_ptr<LinearSolver> make_linear_solver(std::string_view name);

}  // namespace softreel::sim
