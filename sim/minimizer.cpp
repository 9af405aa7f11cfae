#include "sim/minimizer.h"

#include "sim/convergence_test.h"
#include "sim/line_search.h"
#include "sim/method_table.h"
#include "sim/minimizers/fixed_point.h"
#include "sim/minimizers/gradient_descent.h"
#include "sim/minimizers/newton.h"

namespace softreel::sim {
namespace {

struct Problem {
  const Model& model;
  IncrementalPotential& phi;
  const LinearSettings& linear_solver;
  const MinimizerSettings& settings;
};

struct Entry {
  MethodInfo info;
  std::unique_ptr<Minimizer> (*make)(const Problem&);
};

// The one table of minimizers.
constexpr std::array kMinimizers = {
    Entry{Newton::kInfo,
          [](const Problem& p) -> std::unique_ptr<Minimizer> {
            return std::make_unique<Newton>(p.model, p.phi, p.linear_solver, p.settings);
          }},
    Entry{GradientDescent::kInfo,
          [](const Problem& p) -> std::unique_ptr<Minimizer> {
            return std::make_unique<GradientDescent>(p.model, p.phi, p.settings);
          }},
    Entry{FixedPoint::kInfo,
          [](const Problem& p) -> std::unique_ptr<Minimizer> {
            return std::make_unique<FixedPoint>(p.model, p.phi, p.settings);
          }},
};

}  // namespace

Catalogue minimizers() { return catalogue_of<kMinimizers>(); }

std::unique_ptr<Minimizer> make_minimizer(const Model& model, IncrementalPotential& phi,
                                          const LinearSettings& linear_solver, const MinimizerSettings& settings) {
  if (settings.method != "newton" && settings.stop == "decrement")
    throw std::invalid_argument("the Newton decrement stops Newton's method only; " + settings.method +
                                " can stop by residual or step");
  if (settings.method == "gradient-descent" && settings.stop == "step")
    throw std::invalid_argument(
        "the steps of gradient-descent say little about how far the minimum is; it stops by residual");
  return find_method(kMinimizers, settings.method, "minimizer").make({model, phi, linear_solver, settings});
}

}  // namespace softreel::sim
