#pragma once
#include "sim/preconditioner.h"
#include "sim/single_matrix.h"

namespace softreel::sim {

/// Preconditioned conjugate gradients, ended by a projection onto the rigid modes (rigid_modes.h).
///
/// An iteration waits for memory, so where the targets allow it, it works in single precision: on what is left of b,
/// for a correction of x, until the residual in double precision is within the targets (iterative refinement, Higham
/// 2002, "Accuracy and stability of numerical algorithms", chapter 12).
class ConjugateGradientSolver final : public LinearSolver {
 public:
  /// Reads preconditioner and max_iterations (0: 10 times the number of unknowns, at least 1000).
  explicit ConjugateGradientSolver(const LinearSettings& settings = {});
  void analyse(const BlockMatrix& A) override { preconditioner_.analyse(A); }
  void factorize(const BlockMatrix& A) override;
  LinearReport solve(const Eigen::VectorXd& b, const LinearTargets& targets, Eigen::VectorXd& x) override;
  std::size_t bytes() const override;

  /// Gives up after so many iterations; 0: as in the constructor.
  void set_max_iterations(long n) { max_iterations_ = n; }

  /// Block rows [first, first + count) of one body, worked on by one thread in one go: an iteration makes three passes
  /// over the vectors instead of one for each operation.
  struct Chunk {
    int first, count;
    size_t body;
  };

 private:
  enum class End { kDone, kTooSlow, kIndefinite };
  /// The vectors of an iteration, 3n: correction of x, residual, preconditioned residual, direction, A p; and the
  /// blocks of a preconditioner that is nothing else.
  template <class Scalar>
  struct Vectors {
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> dx, r, z, p, Ap;
    std::vector<Scalar> blocks;
    std::size_t bytes() const { return sizeof(Scalar) * (blocks.size() + 5 * static_cast<size_t>(r.size())); }
  };
  void measure();
  bool within(const LinearTargets& targets, double size = 1);
  bool single_precision_serves(const LinearTargets& targets);
  void make_single();
  template <class Scalar>
  End iterate(const LinearTargets& targets, double size, long limit, Vectors<Scalar>& w, LinearReport& report);

  const BlockMatrix* A_ = nullptr;
  LazyPreconditioner preconditioner_;
  long max_iterations_ = 0;
  SingleMatrix single_;
  std::vector<Chunk> chunks_;
  std::vector<double> rz_, rr_, pAp_;  // per chunk: r . z, r . r, p . A p
  std::vector<double> norms_;          // per body: r . r
  Eigen::VectorXd x_next_, r_next_;    // after a correction in single precision
  Eigen::VectorXd r_;                  // of A, in double precision
  Vectors<double> double_;
  Vectors<float> float_;
};

}  // namespace softreel::sim
