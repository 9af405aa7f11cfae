#include "sim/incremental_potential.h"

#include <algorithm>
#include <utility>

#include "sim/collider_contact.h"
#include "sim/contact/surface_contact.h"
#include "sim/parallel.h"
#include "sim/stiffness_scale.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

std::vector<const EnergyTerm*> unchanging(const TermList& all) {
  std::vector<const EnergyTerm*> terms;
  for (const auto* list : {&all.potentials, &all.dissipations, &all.mass_corrections})
    for (const EnergyTerm* t : *list)
      if (!t->changing_stencils()) terms.push_back(t);
  return terms;
}

double& stage_of(const EnergyTerm& term, StepReport& report) {
  if (term.kind() != EnergyKind::kContact) return report.seconds.gradient;
  ++report.contact_evaluations;
  return report.seconds.contact;
}

/// H += the difference of a term's element Hessians; rows and columns of `held` get nothing.
void add_difference(const EnergyTerm& term, const std::vector<double>& before, const std::vector<double>& after,
                    const std::vector<std::uint8_t>& held, BlockMatrix& H) {
  const auto k = static_cast<size_t>(term.stencil_size());
  const auto stencils = term.stencils();
  const double *was = before.data(), *is = after.data();
  for (size_t e = 0; e < stencils.size(); e += k)
    for (size_t a = 0; a < k; ++a)
      for (size_t b = a; b < k; ++b, was += 9, is += 9) {
        const int i = stencils[e + a], j = stencils[e + b];
        if (i < 0 || j < 0 || std::equal(is, is + 9, was)) continue;
        Eigen::Matrix3d change = Eigen::Map<const Eigen::Matrix3d>(is) - Eigen::Map<const Eigen::Matrix3d>(was);
        for (int r = 0; r < 3; ++r) {
          if (held[3 * static_cast<size_t>(i) + static_cast<size_t>(r)]) change.row(r).setZero();
          if (held[3 * static_cast<size_t>(j) + static_cast<size_t>(r)]) change.col(r).setZero();
        }
        H.block(H.find(i, j)) += change;
        if (i != j) H.block(H.find(j, i)) += change.transpose();
      }
}

}  // namespace

IncrementalPotential::IncrementalPotential(const Model& model, const Pins& pins, TermList terms)
    : model_(model),
      pins_(pins),
      terms_(std::move(terms)),
      mass_(model, pins.fixed()),
      assembler_(model.vertices(), unchanging(terms_)) {
  stiffness_ = stiffness_scale(model.potentials, model.x0);
}

bool IncrementalPotential::damped() const { return stage_.a > 0 && !terms_.dissipations.empty(); }

void IncrementalPotential::set_velocity(const Eigen::VectorXd& y) {
  if (damped()) velocity_ = stage_.a * y + stage_.b;
}

double IncrementalPotential::value(const Eigen::VectorXd& y, StepReport& report) {
  double phi = 0;
  if (stage_.inertia > 0) {
    offset_ = y - stage_.y_tilde;
    phi = stage_.inertia * mass_.energy(offset_);
  }
  for (EnergyTerm* term : terms_.potentials) {
    const Stopwatch watch(stage_of(*term, report));
    phi += stage_.beta * term->value(y);
  }
  if (!damped()) return phi;
  set_velocity(y);
  for (EnergyTerm* term : terms_.dissipations) {
    const Stopwatch watch(stage_of(*term, report));
    phi += stage_.beta / stage_.a * term->value(velocity_);
  }
  return phi;
}

void IncrementalPotential::gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g, StepReport& report) {
  g.setZero(y.size());
  for (EnergyTerm* term : terms_.potentials) {
    const Stopwatch watch(stage_of(*term, report));
    term->add_gradient(y, g);
  }
  if (damped()) {
    set_velocity(y);
    for (EnergyTerm* term : terms_.dissipations) {
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
  const long before = assembler_.evaluations();
  assemble(y, definiteness, pins_.fixed(), H);
  report.hessians += assembler_.evaluations() - before;
}

void IncrementalPotential::assemble(const Eigen::VectorXd& y, Definiteness definiteness,
                                    const std::vector<std::uint8_t>& held, BlockMatrix& H) {
  set_velocity(y);
  std::vector<ScaledTerm> fixed, changing;
  const auto add = [&](const auto& terms, const Eigen::VectorXd& at, double scale) {
    for (const EnergyTerm* t : terms) (t->changing_stencils() ? changing : fixed).push_back({t, &at, scale});
  };
  add(terms_.potentials, y, stage_.beta);
  add(terms_.dissipations, velocity_, stage_.beta * stage_.a);
  add(terms_.mass_corrections, y, stage_.inertia);
  static const Eigen::VectorXd kNone;
  const Eigen::VectorXd& masses = stage_.inertia > 0 ? model_.masses : kNone;
  if (changing.empty()) return assembler_.assemble(fixed, masses, held, definiteness, H);
  assembler_.assemble(fixed, masses, held, definiteness, fixed_part_);
  changing_.add(fixed_part_, changing, held, definiteness, H);
}

void IncrementalPotential::drive_to(const Eigen::VectorXd& target, double progress) {
  progress_ = progress;
  if (progress < 1) target_ = target;
  if (model_.surfaces) model_.surfaces->set_progress(progress);
}

void IncrementalPotential::driven(double share) {
  progress_ = share < 1 ? progress_ + share * (1 - progress_) : 1;
  if (model_.surfaces) model_.surfaces->set_progress(progress_);
}

void IncrementalPotential::set_remaining(const Eigen::VectorXd& y, Eigen::VectorXd& d) const {
  const auto& held = pins_.fixed();
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (held[static_cast<size_t>(i)]) d(i) = target_(i) - y(i);
}

void IncrementalPotential::driven_force(const Eigen::VectorXd& y, Eigen::VectorXd& force, StepReport& report) {
  force.setZero(y.size());
  if (pins_.any()) {
    const Stopwatch watch(report.seconds.assemble);
    BlockMatrix whole;
    assemble(y, Definiteness::kClamped, std::vector<std::uint8_t>(pins_.fixed().size(), 0), whole);
    Eigen::VectorXd move = Eigen::VectorXd::Zero(y.size());
    set_remaining(y, move);
    whole.multiply(move, force);
  }
  if (model_.surfaces) {
    const Stopwatch watch(report.seconds.contact);
    Eigen::VectorXd scripted = Eigen::VectorXd::Zero(y.size());
    model_.surfaces->add_driven_force(y, scripted);
    force += stage_.beta * scripted;
  }
  pins_.zero(force);
}

bool IncrementalPotential::harden(const Eigen::VectorXd& y, const Eigen::VectorXd& dy, Definiteness definiteness,
                                  BlockMatrix& H, StepReport& report) {
  const auto may = [](const EnergyTerm* t) { return t->may_harden(); };
  if (!damped() || std::none_of(terms_.dissipations.begin(), terms_.dissipations.end(), may)) return false;
  const Stopwatch watch(report.seconds.assemble);
  set_velocity(y);
  const Eigen::VectorXd dv = stage_.a * dy;
  bool any = false;
  for (EnergyTerm* t : terms_.dissipations) {
    if (!may(t)) continue;
    // Most touches stay as they are: the matrix gets the difference, instead of all terms anew.
    const auto doubles =
        static_cast<size_t>(stencil_count(*t)) * static_cast<size_t>(hessian_doubles(t->stencil_size()));
    std::vector<double> before(doubles), after(doubles);
    const double scale = stage_.beta * stage_.a;
    all_element_hessians(*t, velocity_, scale, definiteness, before.data());
    if (!t->harden(velocity_, dv)) continue;
    any = true;
    all_element_hessians(*t, velocity_, scale, definiteness, after.data());
    add_difference(*t, before, after, pins_.fixed(), H);
  }
  return any;
}

void IncrementalPotential::add_hardened_gradient(const Eigen::VectorXd& y, Eigen::VectorXd& g) {
  set_velocity(y);
  Eigen::VectorXd excess = Eigen::VectorXd::Zero(y.size());
  for (EnergyTerm* t : terms_.dissipations) t->add_hardened_gradient(velocity_, excess);
  pins_.zero(excess);
  g += stage_.beta * excess;
}

void IncrementalPotential::soften() {
  for (EnergyTerm* t : terms_.dissipations) t->soften();
}

double IncrementalPotential::max_step(const Eigen::VectorXd& y, const Eigen::VectorXd& dy, StepReport& report) {
  const bool passable = model_.contact && model_.contact->has_cores();
  if (!passable && !model_.surfaces) return 1;
  const Stopwatch watch(report.seconds.contact);
  const double of_colliders = passable ? model_.contact->max_step(y, dy, pins_.fixed()) : 1;
  const double of_surfaces = model_.surfaces ? model_.surfaces->max_step(y, dy) : 1;
  collider_blocks_ = of_colliders < of_surfaces;
  const double step = std::min(of_colliders, of_surfaces);
  short_steps_ = step < kShortStep ? short_steps_ + 1 : 0;
  return step;
}

}  // namespace softreel::sim
