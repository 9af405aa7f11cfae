#pragma once
// Preconditioners: P^-1 near A^-1 and cheap to apply, symmetric positive definite where A is.
#include "sim/linear_solver.h"

namespace softreel::sim {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// Forgets what was made for another sparsity pattern.
  virtual void analyse(const BlockMatrix&) {}
  /// `A` must stay as long as this is applied. `where`: the bodies, their positions and what is held, as the solve got
  /// them. Returns why it cannot be made, or nothing.
  virtual std::string factorize(const BlockMatrix& A, const LinearTargets& where) = 0;
  /// z := P^-1 r, both 3n. z and r are different vectors.
  virtual void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) = 0;
  /// 9 doubles per block row (column-major) if P^-1 is nothing but these blocks on the diagonal, else null: iterations
  /// apply such a one in the pass that makes r.
  virtual const double* diagonal_blocks() const { return nullptr; }
  /// Memory held at its peak [bytes].
  virtual std::size_t bytes() const = 0;
};

/// Throws std::invalid_argument for an unknown name.
std::unique_ptr<Preconditioner> make_preconditioner(std::string_view name);

/// A preconditioner that is made when the first solve after `set` needs it: what it is made of, the bodies' positions,
/// comes with the solve.
class LazyPreconditioner {
 public:
  explicit LazyPreconditioner(std::string_view name) : made_(make_preconditioner(name)) {}
  void analyse(const BlockMatrix& A) { made_->analyse(A); }
  void set(const BlockMatrix& A) {
    A_ = &A;
    stale_ = true;
  }
  /// Returns why it cannot be made, or nothing.
  const std::string& prepare(const LinearTargets& where) {
    if (stale_) failure_ = made_->factorize(*A_, where);
    stale_ = false;
    return failure_;
  }
  Preconditioner& operator*() const { return *made_; }
  Preconditioner* operator->() const { return made_.get(); }

 private:
  std::unique_ptr<Preconditioner> made_;
  const BlockMatrix* A_ = nullptr;
  bool stale_ = true;
  std::string failure_;
};

}  // namespace softreel::sim
