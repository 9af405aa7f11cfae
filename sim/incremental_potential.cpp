#include "sim/incremental_potential.h"

#include <algorithm>

#include "sim/parallel.h"
#include "sim/stiffness_scale.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

std::vector<const EnergyTerm*> all_terms(const Model& model) {
  std::vector<const EnergyTerm*> terms;
  for (const auto& t : model.potentials) terms.push_back(t.get());
  for (const auto& t : model.dissipations) terms.push_back(t.get());
  for (const auto& t : model.mass_corrections) terms.push_back(t.get());
  return terms;
}

double& stage_of(const EnergyTerm& term, StepReport& report) {
  if (term.kind() != EnergyKind::kContact) return report.seconds.gradient;
  ++report.contact_evaluations;
  return report.seconds.contact;
}

}  // namespace

IncrementalPotential::IncrementalPotential(const Model& model, const Pins& pins)
    : model_(model), pins_(pins), mass_(model, pins.fixed()), assembler_(model.vertices(), all_terms(model)) {
  stiffness_ = stiffness_scale(model.potentials, model.x0);
}

bool IncrementalPotential::damped() const { return stage_.a > 0 && !model_.dissipations.empty(); }

void IncrementalPotential::set_velocity(const Eigen::VectorXd& y) {
  if (damped()) velocity_ = stage_.a * y + stage_.b;
}

double IncrementalPotential::value(const Eigen::VectorXd& y, StepReport& report) {
  double phi = 0;
  if (stage_.inertia > 0) {
    offset_ = y - stage_.y_tilde;
    phi = stage_.inertia * mass_.energy(offset_);
  }
  for (const auto& term : model_.potentials) {
    const Stopwatch watch(stage_of(*term, report));
    phi += stage_.beta * term->value(y);
  }
  if (!damped()) return phi;
  set_velocity(y);
  for (const auto& term : model_.dissipations) {
    const Stopwatch watch(stage_of(*term, report));
    phi += stage_.beta / stage_.a * term->value(velocity_);
  }
  return phi;
}

void IncrementalPotential::gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g, StepReport& report) {
  g.setZero(y.size());
  for (const auto& term : model_.potentials) {
    const Stopwatch watch(stage_of(*term, report));
    term->add_gradient(y, g);
  }
  if (damped()) {
    set_velocity(y);
    for (const auto& term : model_.dissipations) {
      const Stopwatch watch(stage_of(*term, report));
      term->add_gradient(velocity_, g);
    }
  }
  const Stopwatch watch(report.seconds.gradient);
  if (stage_.inertia > 0) {
    offset_ = stage_.inertia * (y - stage_.y_tilde);
    parallel_for(static_cast<int>(g.size()), Work::kVector, [&](int i) { g(i) *= stage_.beta; });
    mass_.add_product(offset_, g);
  } else {
    g *= stage_.beta;
  }
  pins_.zero(g);
}

void IncrementalPotential::hessian(const Eigen::VectorXd& y, Definiteness definiteness, BlockMatrix& H,
                                   StepReport& report) {
  const Stopwatch watch(report.seconds.assemble);
  set_velocity(y);
  std::vector<ScaledTerm> terms;
  for (const auto& t : model_.potentials) terms.push_back({t.get(), &y, stage_.beta});
  for (const auto& t : model_.dissipations) terms.push_back({t.get(), &velocity_, stage_.beta * stage_.a});
  for (const auto& t : model_.mass_corrections) terms.push_back({t.get(), &y, stage_.inertia});
  const long before = assembler_.evaluations();
  static const Eigen::VectorXd kNone;
  assembler_.assemble(terms, stage_.inertia > 0 ? model_.masses : kNone, pins_.fixed(), definiteness, H);
  report.hessians += assembler_.evaluations() - before;
}

bool IncrementalPotential::harden(const Eigen::VectorXd& y, const Eigen::VectorXd& dy) {
  if (!damped()) return false;
  set_velocity(y);
  const Eigen::VectorXd dv = stage_.a * dy;
  bool any = false;
  for (const auto& t : model_.dissipations) any = t->harden(velocity_, dv) || any;
  return any;
}

void IncrementalPotential::add_hardened_gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g) {
  set_velocity(y);
  Eigen::VectorXd excess = Eigen::VectorXd::Zero(y.size());
  for (const auto& t : model_.dissipations) t->add_hardened_gradient(velocity_, excess);
  pins_.zero(excess);
  g += stage_.beta * excess;
}

void IncrementalPotential::soften() {
  for (const auto& t : model_.dissipations) t->soften();
}

double IncrementalPotential::max_step(const Eigen::VectorXd& y, const Eigen::VectorXd& dy) const {
  double step = 1;
  for (const auto& t : model_.potentials) step = std::min(step, t->max_step(y, dy));
  return step;
}

}  // namespace softreel::sim
