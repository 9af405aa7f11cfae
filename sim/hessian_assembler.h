#pragma once
// Adds element Hessians up into one sparse matrix by fixed gather lists.
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/block_matrix.h"
#include "sim/energy_term.h"

namespace softreel::sim {

/// One term with the vector it is evaluated at and the factor of its Hessian.
struct ScaledTerm {
  const EnergyTerm* term = nullptr;
  const Eigen::VectorXd* at = nullptr;
  double scale = 1;
};

/// The sparsity pattern comes from the stencils of the terms and stays; every block sums its contributions in a fixed
/// order, so the result has the same bits for any number of threads.
class HessianAssembler {
 public:
  /// `terms`: in the order in which `assemble` will get them. `vertices`: block rows.
  HessianAssembler(int vertices, std::span<const EnergyTerm* const> terms);

  /// matrix = diag(masses) + sum scale * Hessian; rows and columns of `fixed` degrees of freedom (3n flags)
  /// become those of the identity. `masses`: n [kg], or empty for none.
  void assemble(std::span<const ScaledTerm> terms, const Eigen::VectorXd& masses,
                const std::vector<std::uint8_t>& fixed, Definiteness definiteness, BlockMatrix& matrix);

  /// How often element Hessians were computed, over all terms (constant ones count once).
  long evaluations() const { return evaluations_; }

 private:
  BlockMatrix pattern_;                  // without values
  std::vector<int> upper_, mirror_;      // positions of blocks (i, j), i <= j, and of their transposes
  std::vector<int> upper_row_;           // row of each upper block
  std::vector<size_t> gather_start_;     // per upper block, offsets into gather_
  std::vector<std::uint32_t> gather_;    // slot index * 2 + (1 if to be transposed)
  std::vector<size_t> term_slot_start_;  // per term, in doubles
  std::vector<double> slots_;
  std::vector<double> constant_scale_;  // per term: the scale its slots hold, 0 if they hold nothing lasting
  long evaluations_ = 0;
};

}  // namespace softreel::sim
