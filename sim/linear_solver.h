#pragma once
// Linear systems A x = b with A symmetric positive definite: analyse / factorize / solve.
#include <Eigen/Core>
#include <cstddef>
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
  double rate = 0;          ///< factor of the residual per iteration at the end, as far as the method measures it
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

  /// Before all else: matrices stay for many solves (constant Hessians, equal steps).
  virtual void expect_same_matrix() {}

  /// Memory that the solver took at its peak, without A itself [bytes].
  virtual std::size_t bytes() const = 0;

  /// What later choices depend on; saved with a simulation, so that one that is resumed makes the same choices.
  virtual std::vector<double> memory() const { return {}; }
  virtual void restore(std::span<const double>) {}
};

/// Which solver, and how; each reads what concerns it. A name alone stands for that method with the defaults.
struct LinearSettings {
  std::string method = "auto";                  ///< of linear_solvers()
  std::string preconditioner = "block-jacobi";  ///< of preconditioners(); for cg, gmres and steepest-descent
  double omega = 1.5;                           ///< relaxation of sor [-], in (0, 2)
  int restart = 50;                             ///< of gmres: vectors kept before it begins anew, >= 1
  long max_iterations = 0;                      ///< 0: 10,000; for cg 10 times the number of unknowns

  LinearSettings() = default;
  LinearSettings(std::string_view name) : method(name) {}
  LinearSettings(const std::string& name) : method(name) {}
  LinearSettings(const char* name) : method(name) {}
};

/// Throws std::invalid_argument for an unknown name or a number out of range.
std::unique_ptr<LinearSolver> make_linear_solver(const LinearSettings& settings);

}  // namespace softreel::sim
