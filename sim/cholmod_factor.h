#pragma once
// CHOLMOD's sparse symmetric factorizations of a block matrix (Chen, Davis, Hager, Rajamanickam 2008).
#include <cstddef>
#include <memory>

#include "sim/linear_solver.h"

namespace softreel::sim {

enum class CholmodKind {
  kSupernodal,  ///< L L^T, dense blocks of columns
  kSimplicial,  ///< L D L^T, column by column, without pivoting
};

/// Symbolic and numeric factor after a fill-reducing order of the blocks: nested dissection for large graphs,
/// approximate minimum degree for small ones.
class CholmodFactor {
 public:
  explicit CholmodFactor(CholmodKind kind);
  ~CholmodFactor();

  void analyse(const BlockMatrix& A);
  void factorize(const BlockMatrix& A);
  /// x := A^-1 b. Sets ok or the reason: not positive definite (kSupernodal), singular, not finite, no memory.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearReport& report);

  double flops() const;     ///< floating-point operations of one factorization; counted by analyse
  double nonzeros() const;  ///< of the factor; counted by analyse
  std::size_t bytes() const;
  bool analysed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softreel::sim
