#include "sim/linear_solver.h"

#include <array>
#include <stdexcept>

namespace softreel::sim {
namespace {

struct Entry {
  std::string_view name;
  std::unique_ptr<LinearSolver> (*make)();
};

template <class Solver>
constexpr Entry entry(std::string_view name) {
  return {name, []() -> std::unique_ptr<LinearSolver> { return std::make_unique<Solver>(); }};
}

// The one table of linear solvers.
constexpr std::array kSolvers = {
    entry<AutoSolver>("auto"),
    entry<CholeskySolver>("cholesky"),
    entry<ConjugateGradientSolver>("cg"),
};

}  // namespace

std::span<const std::string_view> linear_solvers() {
  static const auto names = [] {
    std::array<std::string_view, kSolvers.size()> all;
    for (size_t i = 0; i < all.size(); ++i) all[i] = kSolvers[i].name;
    return all;
  }();
  return names;
}

std::unique_ptr<LinearSolver> make_linear_solver(std::string_view name) {
  for (const Entry& e : kSolvers)
    if (e.name == name) return e.make();
  throw std::invalid_argument("unknown linear solver '" + std::string(name) + "'");
}

}  // namespace softreel::sim
