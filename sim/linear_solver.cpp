#include "sim/linear_solver.h"

#include <array>

#include "sim/method_table.h"

namespace softreel::sim {
namespace {

struct Entry {
  MethodInfo info;
  std::unique_ptr<LinearSolver> (*make)();
};

template <class Solver>
constexpr Entry entry(const MethodInfo& info) {
  return {info, []() -> std::unique_ptr<LinearSolver> { return std::make_unique<Solver>(); }};
}

// The one table of linear solvers.
constexpr std::array kSolvers = {
    entry<AutoSolver>({"auto", "cholesky or cg, by counted work", "the cheaper of the two", ""}),
    entry<CholeskySolver>({"cholesky", "supernodal sparse factorization", "direct, O(n^2) in 3D, memory O(n^4/3)",
                           "Chen, Davis, Hager, Rajamanickam 2008"}),
    entry<ConjugateGradientSolver>({"cg", "conjugate gradients", "O(n sqrt(condition))", "Hestenes, Stiefel 1952"}),
};

}  // namespace

Catalogue linear_solvers() { return catalogue_of<kSolvers>(); }

std::unique_ptr<LinearSolver> make_linear_solver(std::string_view name) {
  return find_method(kSolvers, name, "linear solver").make();
}

}  // namespace softreel::sim
