#include "sim/newton.h"

#include <cmath>
#include <limits>
#include <string>

#include "sim/parallel.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRounding = 16 * kEpsilon;  // of forces and energies, relative to stiffness times position
constexpr double kArmijo = 1e-4;
constexpr double kFlatter = 0.9;
constexpr int kMostProposals = 4;  // of a direction in one iteration
constexpr double kShortestStep = 1e-10;
// A linear solve goes as far as the whole step needs, but no further than linear_tolerance at once: the
// next Newton iteration has a better matrix.
constexpr double kLinearShare = 0.3;

std::vector<double> body_norms(const Model& model, const Eigen::VectorXd& g) {
  std::vector<double> norms;
  norms.reserve(model.bodies.size());
  for (const BodyRange& b : model.bodies) {
    const double squared = parallel_sum(3 * b.count, Work::kVector, [&](int i) {
      const double v = g(3 * b.first + i);
      return v * v;
    });
    norms.push_back(std::sqrt(squared));
  }
  return norms;
}

}  // namespace

Newton::Newton(const Model& model, IncrementalPotential& phi, std::string_view linear_solver,
               const NewtonSettings& settings)
    : model_(model), phi_(phi), settings_(settings), linear_(make_linear_solver(linear_solver)) {}

void Newton::prepare() {
  if (analysed_) return;
  StepReport ignored;
  Stage& stage = phi_.stage();
  stage.y_tilde = model_.x0;
  stage.b = Eigen::VectorXd::Zero(model_.x0.size());
  stage.beta = stage.a = 0;
  phi_.hessian(model_.x0, H_, ignored);
  linear_->analyse(H_);
  analysed_ = true;
}

void Newton::minimize(Eigen::VectorXd& y, StepReport& report) {
  const size_t bodies = model_.bodies.size();
  phi_.gradient(y, g_, report);
  const std::vector<double> g0 = body_norms(model_, g_);
  std::vector<double> norms = g0;
  std::vector<double> floors(bodies), target(bodies);
  double phi_rounding = 0;
  for (size_t b = 0; b < bodies; ++b) {
    const BodyRange& body = model_.bodies[b];
    const double beta = phi_.stage().beta;
    const auto diagonal = [&](int i) { return model_.masses(i) + beta * phi_.stiffness()(i); };
    const double squared = parallel_sum(body.count, Work::kVector, [&](int k) {
      const int i = body.first + k;
      const double floor = diagonal(i) * y.segment<3>(3 * i).norm();
      return floor * floor;
    });
    phi_rounding += kRounding * parallel_sum(body.count, Work::kVector, [&](int k) {
                      const int i = body.first + k;
                      return diagonal(i) * y.segment<3>(3 * i).squaredNorm();
                    });
    floors[b] = kRounding * std::sqrt(squared);
    target[b] = std::max(settings_.tolerance * g0[b], floors[b]);
  }
  const auto fail = [&](const std::string& why) {
    report.converged = false;
    report.reason = why;
  };
  for (int iteration = 0;; ++iteration) {
    bool converged = true;
    double worst = 0;
    for (size_t b = 0; b < bodies; ++b) {
      if (!std::isfinite(norms[b])) return fail("forces on '" + model_.bodies[b].name + "' are not finite");
      converged = converged && norms[b] <= target[b];
      // Where the floor at rounding decides, there are no forces to compare with.
      if (target[b] > floors[b]) worst = std::max(worst, norms[b] / g0[b]);
    }
    if (converged) {
      report.residual = std::max(report.residual, worst);
      return;
    }
    if (iteration == settings_.max_iterations) {
      size_t slowest = 0;
      for (size_t b = 1; b < bodies; ++b)
        if (norms[b] / target[b] > norms[slowest] / target[slowest]) slowest = b;
      return fail("Newton's method did not converge in " + std::to_string(iteration) + " iterations on '" +
                  model_.bodies[slowest].name + "'");
    }
    ++report.newton_iterations;
    phi_.soften();
    model_gradient_ = g_;
    bool hardened = false;
    std::string failure;
    for (int proposal = 1;; ++proposal) {
      phi_.hessian(y, H_, report);
      failure = direction(y, linear_targets(target), report);
      if (!failure.empty()) return fail("the linear solver failed: " + failure);
      if (proposal == kMostProposals || !phi_.harden(y, d_)) break;
      hardened = true;
      model_gradient_ = g_;
      phi_.add_hardened_gradient(y, model_gradient_);
    }
    failure = descend(y, phi_rounding, report);
    if (!failure.empty() && hardened) {  // the plain Newton direction goes downhill in any case
      phi_.soften();
      model_gradient_ = g_;
      phi_.hessian(y, H_, report);
      failure = direction(y, linear_targets(target), report);
      if (failure.empty()) failure = descend(y, phi_rounding, report);
    }
    if (!failure.empty()) return fail(failure);
    phi_.gradient(y, g_, report);
    norms = body_norms(model_, g_);
  }
}

/// How far a linear solve with the model's gradient has to go.
std::vector<double> Newton::linear_targets(const std::vector<double>& target) const {
  std::vector<double> result = body_norms(model_, model_gradient_);
  for (size_t b = 0; b < result.size(); ++b)
    result[b] = std::max(kLinearShare * target[b], settings_.linear_tolerance * result[b]);
  return result;
}

/// A step along d. Returns what went wrong, or nothing.
std::string Newton::descend(Eigen::VectorXd& y, double rounding, StepReport& report) {
  const double slope = g_.dot(d_);
  if (!(slope < 0)) return "the search direction does not go downhill";
  return line_search(y, slope, rounding, report) ? "" : "the line search found no lower energy";
}

/// d := -H^-1 g of the model. Returns what went wrong, or nothing.
std::string Newton::direction(const Eigen::VectorXd& y, const std::vector<double>& targets, StepReport& report) {
  const Stopwatch watch(report.seconds.solve);
  if (!analysed_) {
    linear_->analyse(H_);
    analysed_ = true;
  }
  linear_->factorize(H_);
  const LinearReport linear = linear_->solve(-model_gradient_, {model_.bodies, targets, &y, &phi_.held()}, d_);
  report.linear_iterations += linear.iterations;
  report.solver = linear.chosen;
  return linear.ok ? std::string() : linear.reason;
}

/// Backtracking to Armijo's condition. Near the minimum the decrease drowns in the rounding of Phi; there the slope
/// along the direction, which rounding spares, decides (approximate Wolfe condition, Hager and Zhang 2005, section 2).
bool Newton::line_search(Eigen::VectorXd& y, double slope, double rounding, StepReport& report) {
  const double start = phi_.value(y, report);
  for (double step = phi_.max_step(y, d_); step > kShortestStep; step *= 0.5) {
    trial_ = y + step * d_;
    const double phi = phi_.value(trial_, report);
    if (!std::isfinite(phi)) continue;
    bool accept = phi <= start + kArmijo * step * slope;
    if (!accept && phi <= start + rounding) {
      phi_.gradient(trial_, trial_gradient_, report);
      accept = std::abs(trial_gradient_.dot(d_)) <= kFlatter * -slope;
    }
    if (accept) {
      y.swap(trial_);
      return true;
    }
  }
  return false;
}

}  // namespace softreel::sim
