#include "sim/incremental_potential.h"

#include <algorithm>

#include "sim/parallel.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

std::vector<const EnergyTerm*> all_terms(const Model& model) {
  std::vector<const EnergyTerm*> terms;
  for (const auto& t : model.potentials) terms.push_back(t.get());
  for (const auto& t : model.dissipations) terms.push_back(t.get());
  return terms;
}

double& stage_of(const EnergyTerm& term, StepReport& report) {
  if (term.kind() != EnergyKind::kContact) return report.seconds.gradient;
  ++report.contact_evaluations;
  return report.seconds.contact;
}

}  // namespace

IncrementalPotential::IncrementalPotential(const Model& model, const Pins& pins)
    : model_(model), pins_(pins), assembler_(model.vertices(), all_terms(model)) {
  const int n = model.vertices();
  stiffness_.setZero(n);
  std::vector<double> blocks;
  for (const auto& term : model.potentials) {
    const int k = term->stencil_size();
    if (k == 0 || term->kind() == EnergyKind::kContact) continue;
    const auto stencils = term->stencils();
    const size_t elements = stencils.size() / static_cast<size_t>(k);
    blocks.resize(elements * static_cast<size_t>(hessian_doubles(k)));
    term->element_hessians(model.x0, 1.0, Definiteness::kClamped, blocks.data());
    const double* block = blocks.data();
    for (size_t e = 0; e < elements; ++e)
      for (int a = 0; a < k; ++a)
        for (int b = a; b < k; ++b, block += 9)
          if (a == b)
            stiffness_(stencils[e * static_cast<size_t>(k) + static_cast<size_t>(a)]) +=
                std::max({block[0], block[4], block[8]});
  }
}

void IncrementalPotential::set_velocity(const Eigen::VectorXd& y) {
  if (!model_.dissipations.empty()) velocity_ = stage_.a * y + stage_.b;
}

double IncrementalPotential::value(const Eigen::VectorXd& y, StepReport& report) {
  double phi = 0.5 * parallel_sum(model_.vertices(), Work::kVector, [&](int i) {
                 return model_.masses(i) * (y.segment<3>(3 * i) - stage_.y_tilde.segment<3>(3 * i)).squaredNorm();
               });
  for (const auto& term : model_.potentials) {
    const Stopwatch watch(stage_of(*term, report));
    phi += stage_.beta * term->value(y);
  }
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
  set_velocity(y);
  for (const auto& term : model_.dissipations) {
    const Stopwatch watch(stage_of(*term, report));
    term->add_gradient(velocity_, g);
  }
  const Stopwatch watch(report.seconds.gradient);
  parallel_for(model_.vertices(), Work::kVector, [&](int i) {
    g.segment<3>(3 * i) =
        stage_.beta * g.segment<3>(3 * i) + model_.masses(i) * (y.segment<3>(3 * i) - stage_.y_tilde.segment<3>(3 * i));
  });
  pins_.zero(g);
}

void IncrementalPotential::hessian(const Eigen::VectorXd& y, BlockMatrix& H, StepReport& report) {
  const Stopwatch watch(report.seconds.assemble);
  set_velocity(y);
  std::vector<ScaledTerm> terms;
  for (const auto& t : model_.potentials) terms.push_back({t.get(), &y, stage_.beta});
  for (const auto& t : model_.dissipations) terms.push_back({t.get(), &velocity_, stage_.beta * stage_.a});
  const long before = assembler_.evaluations();
  assembler_.assemble(terms, model_.masses, pins_.fixed(), H);
  report.hessians += assembler_.evaluations() - before;
}

bool IncrementalPotential::harden(const Eigen::VectorXd& y, const Eigen::VectorXd& dy) {
  if (model_.dissipations.empty()) return false;
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
