#pragma once
// Adds element Hessians up into one sparse matrix by fixed gather lists.
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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

/// The sparsity pattern comes from the stencils of the terms and stays. The stencils of every term are cut into parts,
/// as many for any number of threads; a part adds its element Hessians up while they are in the cache, straight into
/// the matrix where no other part has a share, else into a place of its own, and these are summed in the order of
/// parts. So the result has the same bits for any number of threads, and element Hessians never go to memory.
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
  struct TermPlan {
    std::vector<std::uint32_t> targets;    // per stencil and upper block of it: where it goes, see Target
    std::vector<double> constant;          // of a constant Hessian: its blocks
    std::optional<double> constant_scale;  // and the factor in them; none: there is nothing yet
  };
  struct Target;

  void lay_out(size_t n, std::span<const std::pair<int, int>> blocks);
  void add_part(int part, std::span<const ScaledTerm> terms, Definiteness definiteness, BlockMatrix& matrix);
  static void add(const double* blocks, std::span<const std::uint32_t> targets, double* matrix, double* shared);

  BlockMatrix pattern_;              // without values
  std::vector<int> upper_, mirror_;  // positions of blocks (i, j), i <= j, and of their transposes
  std::vector<int> upper_row_;       // row of each upper block
  std::vector<size_t> share_start_;  // per upper block, offsets into the shares of several parts; none: it has one part
  std::vector<double> shared_;       // 9 doubles each
  std::vector<std::uint8_t> empty_;  // per upper block: no stencil has it
  std::vector<TermPlan> plans_;      // as the terms
  int parts_ = 1;
  long evaluations_ = 0;
};

}  // namespace softreel::sim
