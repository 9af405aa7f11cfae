#include "sim/minimizer.h"

#include <algorithm>

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

constexpr const char* kBlocked = "contact lets nothing move";

}  // namespace

Minimizer::Minimizer(const Model& model, IncrementalPotential& phi, const MinimizerSettings& settings)
    : model_(model), phi_(phi), test_(model, phi, settings), max_iterations_(settings.max_iterations) {}

void Minimizer::minimize(Eigen::VectorXd& y, const Eigen::VectorXd* guess, StepReport& report) {
  Failure failure;
  run(y, guess, report, failure);
  report.converged = failure.empty();
  report.reason = failure;
}

void Minimizer::run(Eigen::VectorXd& y, const Eigen::VectorXd* guess, StepReport& report, Failure& failure) {
  phi_.begin();
  failure = begin();
  if (!failure.empty()) return;
  phi_.gradient(y, g_, report);
  test_.start(y, g_);
  if (guess && test_.measured_at_start()) {
    phi_.gradient(*guess, guess_gradient_, report);
    if (guess_gradient_.squaredNorm() < g_.squaredNorm()) {
      y = *guess;
      g_.swap(guess_gradient_);
    }
  }
  for (int iteration = 0; phi_.driving(); ++iteration) {
    failure = test_.look(g_);
    if (failure.empty() && iteration == max_iterations_) failure = "what is driven did not arrive";
    if (failure.empty()) failure = drive(y, report);
    if (failure.empty() && phi_.blocked()) failure = kBlocked;
    if (!failure.empty()) return;
    phi_.gradient(y, g_, report);
    test_.restart();
  }
  for (int iteration = 0;; ++iteration) {
    const bool stop_after_step = !test_.fired().empty();
    failure = test_.look(g_);
    if (!failure.empty()) {
      failure = not_finite(failure);
      return;
    }
    if (stop_after_step || !test_.fired().empty()) {
      report.residual = std::max(report.residual, test_.residual());
      report.stopped_by = test_.fired();
      return end();
    }
    if (iteration == max_iterations_) {
      failure = std::string(title()) + " did not converge in " + std::to_string(iteration) + " iterations on '" +
                test_.slowest() + "'" + std::string(advice());
      return;
    }
    failure = advance(iteration, y, report);
    if (failure.empty() && phi_.blocked()) failure = kBlocked;
    if (!failure.empty()) return;
    phi_.gradient(y, g_, report);
  }
}

Minimizer::Failure Minimizer::drive(Eigen::VectorXd&, StepReport&) {
  return std::string(title()) + " cannot take what is driven through contact; Newton's method can";
}

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
