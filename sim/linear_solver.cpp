#include "sim/linear_solver.h"

#include <array>
#include <stdexcept>
#include <type_traits>

#include "sim/auto_solver.h"
#include "sim/cholesky_solver.h"
#include "sim/conjugate_gradient_solver.h"
#include "sim/gauss_seidel_solver.h"
#include "sim/gmres_solver.h"
#include "sim/jacobi_solver.h"
#include "sim/ldlt_solver.h"
#include "sim/lu_solver.h"
#include "sim/method_table.h"
#include "sim/multigrid_solver.h"
#include "sim/steepest_descent_solver.h"

namespace softreel::sim {
namespace {

struct Entry {
  MethodInfo info;
  std::unique_ptr<LinearSolver> (*make)(const LinearSettings&);
};

template <class Solver>
constexpr Entry entry(const MethodInfo& info) {
  return {info, [](const LinearSettings& settings) -> std::unique_ptr<LinearSolver> {
            if constexpr (std::is_constructible_v<Solver, const LinearSettings&>)
              return std::make_unique<Solver>(settings);
            else
              return std::make_unique<Solver>();
          }};
}

// The one table of linear solvers. Costs: n unknowns of a solid in 3D, kappa the condition number of P^-1 A.
constexpr std::array kSolvers = {
    entry<AutoSolver>({"auto", "cholesky or cg, by counted work", "the cheaper of the two", ""}),
    entry<CholeskySolver>({"cholesky", "supernodal L L^T, nested dissection", "direct, O(n^2), memory O(n^(4/3))",
                           "Chen, Davis, Hager, Rajamanickam 2008"}),
    entry<LdltSolver>({"ldlt", "column by column, L D L^T; indefinite matrices too", "direct, O(n^2), no dense blocks",
                       "Davis 2005; Chen et al. 2008"}),
    entry<LuSolver>({"lu", "multifrontal L U with pivoting; any matrix", "direct, O(n^2), twice the memory",
                     "Davis 2004, UMFPACK"}),
    entry<JacobiSolver>(
        {"jacobi", "P = D; diverges on most solids", "O(n kappa), if it converges", "Saad 2003, section 4.1"}),
    entry<GaussSeidelSolver>({"gauss-seidel", "P = D + L; sequential", "O(n kappa)", "Saad 2003, section 4.1"}),
    entry<SorSolver>({"sor", "P = D/omega + L; sequential", "O(n kappa); O(n sqrt(kappa)) for the best omega",
                      "Young 1954; Saad 2003, section 4.1"}),
    entry<SteepestDescentSolver>({"steepest-descent", "along the preconditioned residual", "O(n kappa)",
                                  "Cauchy 1847; Saad 2003, section 5.3.1"}),
    entry<ConjugateGradientSolver>({"cg", "preconditioned conjugate gradients", "O(n sqrt(kappa))",
                                    "Hestenes, Stiefel 1952; Saad 2003, section 9.2"}),
    entry<GmresSolver>({"gmres", "restarted, preconditioned from the right; any matrix",
                        "O(n sqrt(kappa) restart), memory O(n restart)", "Saad, Schultz 1986"}),
    entry<MultigridSolver>(
        {"multigrid", "smoothed aggregation of the rigid-body modes, V-cycles", "O(n)", "Vanek, Mandel, Brezina 1996"}),
};

}  // namespace

Catalogue linear_solvers() { return catalogue_of<kSolvers>(); }

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSettings& settings) {
  if (settings.restart < 1) throw std::invalid_argument("gmres keeps at least one vector before it begins anew");
  if (settings.max_iterations < 0) throw std::invalid_argument("the limit of iterations is negative");
  return find_method(kSolvers, settings.method, "linear solver").make(settings);
}

}  // namespace softreel::sim
