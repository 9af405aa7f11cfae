#include "sim/minimizers/newton.h"

#include <cmath>

#include "sim/method_table.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

constexpr int kClampedIterations = 4;  // of a solve, after which clamping may be what slows it down
constexpr int kClampedAgain = 2;       // after an exact Hessian that was indefinite
constexpr int kLongestMistrust = 31;   // solves that begin clamped, after exact ones that were indefinite
constexpr int kMostProposals = 4;      // of a direction in one iteration
// A linear solve goes as far as the whole step needs, but no further than its own matrix is worth: the next Newton
// iteration has a better one (Eisenstat and Walker 1996, "Choosing the forcing terms in an inexact Newton method",
// choice 2). Where less than a decade is missing to the end, the way to it costs less than another matrix.
constexpr double kLinearShare = 0.3;
constexpr double kFirstForcing = 1e-2, kForcingFactor = 0.9;
constexpr double kNearTheEnd = 10;
// Clamping, and contact that begins within a step, make steps too short: where the slope at the end of a whole step is
// still this part of what it was, the same direction is gone on with, to where the slope would vanish if it went on to
// change as it did, and at most so many times the step. That costs no Hessian and no linear solve; out of a saddle
// point, from which clamped steps grow by a small factor each, it is exponentially faster. Only with contact between
// surfaces: elsewhere it saves a tenth of the iterations, and may carry a crushed solid into another minimum.
constexpr double kStillSteep = 0.5, kLongestGoingOn = 4;
// Shifts, relative to the mean of the diagonal.
constexpr double kSmallestShift = 1e-8, kLargestShift = 1e6, kShiftGrowth = 10;

struct Entry {
  MethodInfo info;
};
// In the order of Newton::Modification.
constexpr std::array kModifications = {
    Entry{{"auto", "exact where that is positive definite, else clamped", "as the one it takes", "Longva et al. 2023"}},
    Entry{{"clamped", "negative eigenvalues of each element's Hessian set to zero", "none beside the element",
           "Teran, Sifakis, Irving, Fedkiw 2005, section 6"}},
    Entry{{"shifted", "exact Hessian plus c I, c as large as needed", "1 factorization a trial of c",
           "Nocedal, Wright 2006, section 3.4"}},
};

bool constant_hessians(const Model& model) {
  for (const auto* list : {&model.potentials, &model.dissipations, &model.mass_corrections})
    for (const auto& term : *list)
      if (term->changing_stencils() || (term->stencil_size() > 0 && !term->constant_hessian())) return false;
  return true;
}

}  // namespace

Catalogue hessian_modifications() { return catalogue_of<kModifications>(); }

Newton::Newton(const Model& model, IncrementalPotential& phi, const LinearSettings& linear_solver,
               const MinimizerSettings& settings)
    : Minimizer(model, phi, settings),
      linear_tolerance_(settings.linear_tolerance),
      modification_(
          static_cast<Modification>(&find_method(kModifications, settings.hessian, "Hessian") - kModifications.data())),
      linear_(make_linear_solver(linear_solver)),
      search_(phi, settings.line_search),
      constant_(constant_hessians(model)) {
  if (constant_) linear_->expect_same_matrix();
}

/// Builds the pattern and the symbolic work before the first step needs it (a resumed run restores into it).
void Newton::prepare() {
  if (analysed_ >= 0) return;
  StepReport ignored;
  Stage& stage = phi_.stage();
  stage.y_tilde = model_.x0;
  stage.b = Eigen::VectorXd::Zero(model_.x0.size());
  stage.beta = stage.a = 0;
  phi_.hessian(model_.x0, definiteness_, H_, ignored);
  assembled_ = {};
  linear_->analyse(H_);
  analysed_ = H_.pattern;
}

std::vector<double> Newton::memory() const {
  std::vector<double> saved{shift_, static_cast<double>(mistrust_), static_cast<double>(next_mistrust_)};
  const std::vector<double> linear = linear_->memory();
  saved.insert(saved.end(), linear.begin(), linear.end());
  return saved;
}

void Newton::restore(std::span<const double> saved) {
  if (saved.size() < 3) throw std::invalid_argument("memory of another minimizer");
  prepare();
  shift_ = saved[0];
  mistrust_ = static_cast<int>(saved[1]);
  next_mistrust_ = static_cast<int>(saved[2]);
  linear_->restore(saved.subspan(3));
}

Minimizer::Failure Newton::begin() {
  next_exact_ = kClampedIterations;
  last_slope_ = 0;
  const bool clamped =
      modification_ == Modification::kClamped || (modification_ == Modification::kAuto && mistrust_ > 0);
  definiteness_ = clamped ? Definiteness::kClamped : Definiteness::kExact;
  if (mistrust_ > 0) --mistrust_;
  mistrusted_ = clamped;
  return {};
}

void Newton::end() {
  if (!mistrusted_) next_mistrust_ = 0;
}

Minimizer::Failure Newton::advance(int iteration, Eigen::VectorXd& y, StepReport& report) {
  while (iteration > 0 && go_on(y, report)) phi_.gradient(y, g_, report);
  const double norm = g_.norm(), factor = norm / last_norm_;
  forcing_ = constant_        ? 0  // the matrix is right: to the end at once
             : iteration == 0 ? kFirstForcing
                              : std::min(kFirstForcing, kForcingFactor * factor * factor);
  last_norm_ = norm;
  ++report.newton_iterations;
  if (modification_ == Modification::kAuto && iteration == next_exact_) definiteness_ = Definiteness::kExact;
  Failure failure;
  if (step(iteration, y, report, failure)) return {};
  shift_ = 0;
  return failure;
}

/// H_ := the Hessian at y, unless it is that already.
void Newton::assemble(const Eigen::VectorXd& y, StepReport& report) {
  const Stage& stage = phi_.stage();
  const Scales scales{stage.inertia, stage.beta, stage.a};
  if (constant_ && scales == assembled_ && applied_shift_ == 0) return;
  phi_.hessian(y, definiteness_, H_, report);
  assembled_ = scales;
  applied_shift_ = 0;
  factorized_ = false;
}

/// Along the last direction, if the last step was too short. False if it was not, or no way down is found there.
bool Newton::go_on(Eigen::VectorXd& y, StepReport& report) {
  if (last_slope_ == 0) return false;
  const double slope = g_.dot(d_), share = slope / last_slope_;
  const double before = last_length_;
  last_slope_ = 0;
  if (!(slope < 0) || share < kStillSteep) return false;
  const double first = before * (share < 1 ? std::min(share / (1 - share), kLongestGoingOn) : kLongestGoingOn);
  const double length = search_.along(d_, slope, test_.value_rounding(), first, y, report);
  if (length == 0) return false;
  if (length >= first) {
    last_slope_ = slope;
    last_length_ = length;
  }
  return true;
}

/// The held go the rest of their way d_h, the others take Newton's step with them: H_ff d_f = -g_f - H_fh d_h. What
/// stands in the way is pushed, since contact is in H_fh; continuous collision detection cuts the step. There is no
/// energy to look at: what drives puts in whatever it takes.
Minimizer::Failure Newton::drive(Eigen::VectorXd& y, StepReport& report) {
  ++report.newton_iterations;
  forcing_ = kFirstForcing;
  phi_.soften();
  definiteness_ = Definiteness::kClamped;
  assemble(y, report);
  phi_.driven_force(y, model_gradient_, report);
  model_gradient_ += g_;
  Failure failure;
  if (!direction(y, report, failure)) return failure;
  phi_.set_remaining(y, d_);
  const double share = phi_.max_step(y, d_, report);
  y += share * d_;
  phi_.driven(share);
  return {};
}

/// kAuto only: the exact Hessian gave no way down, so clamped ones for a while. If it has shown itself `indefinite`, so
/// do the next solves: the longer, the more often that happens.
void Newton::clamp_for_a_while(int iteration, bool indefinite) {
  definiteness_ = Definiteness::kClamped;
  next_exact_ = iteration + 1 + kClampedAgain;
  mistrusted_ = true;
  if (!indefinite) return;
  mistrust_ = next_mistrust_ = std::min(2 * next_mistrust_ + 1, kLongestMistrust);
}

/// One iteration from y, where the gradient is g_. Returns false, with the reason, if no way down was found.
bool Newton::step(int iteration, Eigen::VectorXd& y, StepReport& report, std::string& failure) {
  phi_.soften();
  const auto model_at = [&] {
    assemble(y, report);
    test_.see_hessian(H_, y);
  };
  model_at();
  model_gradient_ = g_;
  bool found = direction(y, report, failure);
  const auto may_clamp = [&] { return modification_ == Modification::kAuto && definiteness_ == Definiteness::kExact; };
  // One that conjugate gradients did not see to be indefinite may still give a way up.
  if (may_clamp() && (!found || !(g_.dot(d_) < 0))) {
    clamp_for_a_while(iteration, found ? g_.dot(d_) > 0 : indefinite_);
    model_at();
    found = direction(y, report, failure);
  }
  bool hardened = false;
  for (int proposal = 1; found && proposal < kMostProposals && phi_.harden(y, d_, definiteness_, H_, report);
       ++proposal) {
    hardened = true;
    factorized_ = false;
    test_.see_hessian(H_, y);
    model_gradient_ = g_;
    phi_.add_hardened_gradient(y, model_gradient_);
    found = direction(y, report, failure);
  }
  while (true) {
    if (found) {
      const double slope = g_.dot(d_);
      const bool at_once = constant_ && applied_shift_ == 0 && slope < 0;  // a quadratic function
      if (at_once) y += d_;
      const double length = at_once     ? 1
                            : slope < 0 ? search_.along(d_, slope, test_.value_rounding(), 1, y, report)
                                        : 0;
      if (length > 0) {
        if (applied_shift_ == 0 && !hardened) {  // a shifted step is short for another reason than being nearly there
          test_.look_at_slope(slope);
          test_.look_at_step(y, d_, length >= 1);
        }
        last_slope_ = model_.surfaces && length >= 1 && applied_shift_ == 0 && !hardened && !constant_ ? slope : 0;
        last_length_ = length;
        shift_ = shift_ > kSmallestShift ? shift_ / kShiftGrowth : 0;
        return true;
      }
      failure = slope < 0 ? "the line search found no lower energy" : "the search direction does not go downhill";
    }
    if (!found && !indefinite_) return false;  // the linear solver says why
    if (hardened) {                            // the plain Newton direction goes downhill in any case
      hardened = false;
      phi_.soften();
      model_at();
      model_gradient_ = g_;
    } else if (may_clamp()) {
      clamp_for_a_while(iteration, false);
      model_at();
    } else if (!shift_more()) {
      return false;
    }
    found = direction(y, report, failure);
  }
}

/// A larger c. Returns false at its end.
bool Newton::shift_more() {
  if (shift_ >= kLargestShift) return false;
  shift_ = std::max(kSmallestShift, kShiftGrowth * shift_);
  return true;
}

/// How far a linear solve with the model's gradient has to go.
std::vector<double> Newton::linear_targets() const {
  std::vector<double> result = test_.body_norms(model_gradient_);
  const double forcing = std::max(forcing_, linear_tolerance_);
  for (size_t b = 0; b < result.size(); ++b) {
    const double end = kLinearShare * test_.linear_targets()[b];
    const bool near = forcing * result[b] < kNearTheEnd * end;
    result[b] = std::max(end, (near ? linear_tolerance_ : forcing) * result[b]);
  }
  return result;
}

/// d := -(H + c I)^-1 g of the model. Returns false, with the reason, if there is none with any c.
bool Newton::direction(const Eigen::VectorXd& y, StepReport& report, std::string& failure) {
  const Stopwatch watch(report.seconds.solve);
  if (analysed_ != H_.pattern) {
    linear_->analyse(H_);
    analysed_ = H_.pattern;
    factorized_ = false;
  }
  const std::vector<double> targets = linear_targets();
  // Of the body at rest: the diagonal of H itself can be anything in a bad state, zero and less included.
  const Stage& stage = phi_.stage();
  const double mean = stage.inertia * model_.masses.mean() + stage.beta * phi_.stiffness().mean();
  while (true) {
    const bool tried = modification_ == Modification::kAuto && definiteness_ == Definiteness::kExact;
    if (const double c = tried ? 0 : shift_ * mean; c != applied_shift_) {
      for (const int k : H_.diagonal) H_.block(k).diagonal().array() += c - applied_shift_;
      applied_shift_ = c;
      factorized_ = false;
    }
    if (!factorized_) linear_->factorize(H_);
    factorized_ = true;
    const LinearReport linear = linear_->solve(-model_gradient_, {model_.bodies, targets, &y, &phi_.held()}, d_);
    report.linear_iterations += linear.iterations;
    report.solver = linear.chosen;
    if (linear.ok) return true;
    failure = "the linear solver failed: " + linear.reason;
    indefinite_ = linear.indefinite;
    if (!linear.indefinite || tried || !shift_more()) return false;
  }
}

}  // namespace softreel::sim
