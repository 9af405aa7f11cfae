#include "app/clip_world.h"

#include <fmt/format.h>

#include "app/field_world.h"
#include "app/touching_surfaces.h"
#include "app/world.h"

namespace softreel::app {

ClipWorld::ClipWorld(const assets::Scene& scene, const Shapes& shapes)
    : scene_(scene), shows_pressure_(shows_pressure(scene)) {
  if (!scene.fields.empty()) fields_ = build_fields(scene, shapes);
  if (!scene.soft.empty() || !scene.cloth.empty() || !scene.springs.empty())
    bodies_ = std::make_unique<sim::Simulation>(build_model(scene, shapes), simulation_settings(scene));
  if (bodies_ && keeps_momentum(scene)) momentum_.emplace(bodies_->model(), scene.gravity);
}

std::optional<StepFailure> ClipWorld::step(double h, sim::StepReport& sum) {
  t_ += h;
  if (bodies_) {
    sum.add(bodies_->step(h));
    if (!sum.converged) return StepFailure{sum.reason, bodies_->implicit()};
  }
  for (size_t i = 0; i < fields_.size(); ++i) {
    sim::StepReport report = fields_[i].step(h);
    if (!report.converged) return StepFailure{fmt::format("field '{}': {}", scene_.fields[i].name, report.reason)};
    if (bodies_) report.steps = 0;  // steps of the scene are counted once
    if (i > 0) report.steps = 0;
    sum.add(report);
  }
  return std::nullopt;
}

ContactFigures ClipWorld::contact_figures(const sim::StepReport& sum) const {
  const sim::SurfaceContact& contact = *bodies_->model().surfaces;
  const sim::State& state = bodies_->state();
  const sim::SurfaceContactReport report = contact.report(state.x);
  ContactFigures figures;
  figures.candidates = static_cast<double>(report.candidates);
  figures.active = static_cast<double>(report.active);
  if (report.active > 0) {
    figures.smallest_gap = report.smallest_gap;
    figures.deepest = report.deepest;
  }
  const sim::SlidingCount sliding = contact.count_sliding(state.x, state.v, scene_.contact.slip_speed);
  figures.sticks = static_cast<double>(sliding.sticks);
  figures.slips = static_cast<double>(sliding.slips);
  for (const Crossing& c : crossings(contact.surfaces(), state.x, state.t))
    figures.crossings += static_cast<double>(c.pairs);
  figures.stiffenings = static_cast<double>(sum.stiffenings);
  figures.stiffening_energy = contact.stiffening_energy();
  return figures;
}

CachedFrame ClipWorld::frame(const sim::StepReport& sum) const {
  CachedFrame frame;
  if (bodies_) {
    frame.state = bodies_->state();
    frame.memory = bodies_->memory();
    frame.figures.energies = bodies_->energies();
    if (momentum_) frame.figures.momentum_drift = momentum_->drift(frame.state, frame.figures.energies);
    if (bodies_->sleeps()) frame.figures.asleep = bodies_->asleep();
    if (bodies_->model().surfaces) frame.figures.contact = contact_figures(sum);
    if (shows_pressure_) {
      bodies_->contact_forces(contact_force_);
      frame.contact_force = contact_force_;
    }
  } else {
    frame.state.t = t_;
  }
  frame.figures.steps = static_cast<double>(sum.steps);
  frame.figures.newton_iterations = static_cast<double>(sum.newton_iterations);
  frame.figures.linear_iterations = static_cast<double>(sum.linear_iterations);
  frame.figures.retried_steps = static_cast<double>(sum.retries);
  frame.figures.residual = sum.residual;
  for (const sim::Field& field : fields_) frame.fields.push_back({field.value(), field.rate(), field.memory()});
  return frame;
}

void ClipWorld::restore(const CachedFrame& frame) {
  t_ = frame.state.t;
  contact_force_ = frame.contact_force;
  if (bodies_) bodies_->restore(frame.state, frame.memory);
  for (size_t i = 0; i < fields_.size(); ++i)
    fields_[i].restore(t_, frame.fields[i].value, frame.fields[i].rate, frame.fields[i].memory);
}

}  // namespace softreel::app
