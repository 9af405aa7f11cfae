// Simulation's implicit step: from the prediction of its method to the minimum, around what stands in the way.
#include <algorithm>

#include "sim/collider_contact.h"
#include "sim/contact/surface_contact.h"
#include "sim/simulation.h"
#include "sim/stopwatch.h"

namespace softreel::sim {

void Simulation::implicit_step(double h, StepReport& report) {
  ImplicitMethod& method = *method_.implicit_method;
  method.predict(state_, h, acceleration(h, report), phi_->stage());
  const double fraction = method.fraction(), end = state_.t + h;
  const bool still = phi_->stage().inertia == 0;
  predicted_ = still ? state_.x : Eigen::VectorXd(state_.x + fraction * h * state_.v);
  begin_terms(context(state_, predicted_, h, state_.t + fraction * h), report);
  // What is held goes from where it is to where it belongs at the end; y lies in between.
  const auto place = [&](Eigen::VectorXd& y) {
    if (!pins_.any()) return;
    y = state_.x + (y - state_.x) / fraction;
    pins_.place(end, y);
    y = state_.x + fraction * (y - state_.x);
  };
  Eigen::VectorXd y = predicted_;
  place(y);
  const Eigen::VectorXd target = y;
  const double progress = start_of_solve(end, target, y, report);
  // Two places to start from: where the vertices are and where they are heading. The lower of the two is nearer: in
  // free motion the second, before an impact the first. What is driven through contact has to come along.
  if ((model_.contact || model_.surfaces) && !driven_ && !still) {
    Eigen::VectorXd here = state_.x;
    place(here);
    if (phi_->value(here, report) < phi_->value(y, report)) y.swap(here);
  }
  const Stage& stage = phi_->stage();
  bool guessed = !still && start_guess_.any();
  if (guessed) {
    start_guess_.guess(stage, h, guess_);
    place(guess_);
    if (model_.surfaces || model_.contact) {
      const Stopwatch watch(report.seconds.contact);
      guessed = progress == 1 && free_share(guess_ - state_.x) == 1;
    }
  }
  solve(target, progress, guessed ? &guess_ : nullptr, y, report);
  if (!report.converged) return;
  if (!still) start_guess_.accept(stage, h, y);
  method.finish(y, h, state_);
  if (pins_.any()) {
    pins_.place(end, state_.x);
    if (!still) pins_.drive(end, state_.v);
  }
}

/// The share, in [0, 1], of a move from the state on which nothing passes through anything.
double Simulation::free_share(const Eigen::VectorXd& move) const {
  const double share = model_.contact ? model_.contact->max_step(state_.x, move, pins_.fixed()) : 1;
  return model_.surfaces ? std::min(share, model_.surfaces->max_step(state_.x, move)) : share;
}

/// A solve may only begin where nothing was jumped over on the way there: cuts the way to y. What is held goes to its
/// end (`target`) nevertheless, unless contact between surfaces has to let it: returns the share of its way that it has
/// gone. `end` of the step [s].
double Simulation::start_of_solve(double end, const Eigen::VectorXd& target, Eigen::VectorXd& y, StepReport& report) {
  const bool passable = model_.contact && model_.contact->has_cores();
  if (!passable && !model_.surfaces) return 1;
  const Stopwatch watch(report.seconds.contact);
  SurfaceContact* surfaces = model_.surfaces;
  if (surfaces) {
    driven_ = surfaces->colliders_move() || pins_.move(state_.t, end);
    surfaces->set_progress(0);
  }
  const double share = free_share(y - state_.x);
  if (share < 1) y = state_.x + share * (y - state_.x);
  if (share < 1 && !driven_)
    for (Eigen::Index i = 0; i < y.size(); ++i)
      if (pins_.fixed()[static_cast<size_t>(i)]) y(i) = target(i);
  const double progress = driven_ ? share : 1;
  if (surfaces) surfaces->set_progress(progress);
  return progress;
}

/// "'a'": the body that an analytic collider stopped last.
std::string Simulation::at_collider() const {
  const int vertex = model_.contact->blocking();
  for (const BodyRange& body : model_.bodies)
    if (vertex >= body.first && vertex < body.first + body.count) return "'" + body.name + "'";
  return "";
}

/// Goes from y to the minimum. Contact that gives way too far is stiffened, and the solve taken again from its start.
void Simulation::solve(const Eigen::VectorXd& target, double progress, const Eigen::VectorXd* guess, Eigen::VectorXd& y,
                       StepReport& report) {
  SurfaceContact* surfaces = model_.surfaces;
  if (!surfaces) {
    minimizer_->minimize(y, guess, report);
    if (!report.converged && phi_->blocked())
      report.reason += ": " + at_collider() + " is too fast for a collider to stop it";
    return;
  }
  const Eigen::VectorXd start = y;
  while (true) {
    y = start;
    phi_->drive_to(target, progress);
    minimizer_->minimize(y, guess, report);
    // Where softer contact has led is mostly nearer than the start, and nothing was jumped over on the way.
    guess_ = y;
    guess = driven_ ? nullptr : &guess_;
    const bool stiffened = report.converged
                               ? surfaces->stiffen_near(y)
                               : phi_->blocked() && !phi_->collider_blocks() && surfaces->stiffen_blocking();
    if (!stiffened) break;
    ++report.stiffenings;
  }
  if (report.converged) return;
  if (surfaces->at_bound())
    report.reason = surfaces->blocking() + " are pressed together harder than contact can hold" +
                    (driven_ ? ": what is driven (pins, colliders with a motion) leaves them no room" : " in one step");
  else if (phi_->blocked())
    report.reason += ": " + (phi_->collider_blocks() ? at_collider() + " is too fast for a collider to stop it"
                                                     : surfaces->blocking());
}

}  // namespace softreel::sim
