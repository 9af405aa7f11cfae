#include "sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/collider_contact.h"
#include "sim/contact/surface_contact.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

// A vertex that crosses so many times the scene in one step is not simulated any more.
constexpr double kRunaway = 100;
constexpr double kLargestTurn = 90;  // of a pin in one step [deg]

}  // namespace

Simulation::Simulation(Model model, const SimulationSettings& settings)
    : model_(std::move(model)),
      pins_(model_),
      settings_(settings),
      state_{0, model_.x0, model_.v0},
      method_(make_integrator(settings.integrator)) {
  pins_.zero(state_.v);  // a body's velocity is not that of what holds it
  if (settings.sleep_speed > 0) sleep_ = std::make_unique<Sleep>(model_, settings.sleep_speed);
  arrange();
  if (model_.vertices() > 0) {
    const Eigen::Map<const Eigen::Matrix3Xd> x(model_.x0.data(), 3, model_.vertices());
    extent_ = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  }
  extent_ = std::max(extent_, 1.0);
}

Simulation::~Simulation() = default;

/// Builds what steps of the awake bodies need.
void Simulation::arrange() {
  terms_ = terms_of(model_, sleep_ ? std::span<const std::uint8_t>(sleep_->asleep()) : std::span<const std::uint8_t>());
  if (implicit()) {
    minimizer_.reset();
    phi_ = std::make_unique<IncrementalPotential>(model_, pins_, terms_);
    minimizer_ = make_minimizer(model_, *phi_, settings_.linear_solver, settings_.minimizer);
  } else {
    mass_ = std::make_unique<MassMatrix>(model_, pins_.fixed());
  }
}

/// After bodies have fallen asleep, or woken.
void Simulation::change_sleepers() {
  const std::vector<std::uint8_t>& asleep = sleep_->asleep();
  pins_.hold(asleep);
  for (size_t b = 0; b < asleep.size(); ++b)
    if (asleep[b]) state_.v.segment(3 * model_.bodies[b].first, 3 * model_.bodies[b].count).setZero();
  if (model_.surfaces) {
    model_.surfaces->leave_out({});
    const double all = model_.surfaces->value(state_.x);
    if (sleep_->any()) model_.surfaces->leave_out(pins_.fixed());
    resting_contact_ = all - model_.surfaces->value(state_.x);
  }
  arrange();
}

/// Rounding, and what methods keep of earlier steps, must not move what is asleep.
void Simulation::keep_asleep(const State& before) {
  const std::vector<std::uint8_t>& asleep = sleep_->asleep();
  for (size_t b = 0; b < asleep.size(); ++b) {
    if (!asleep[b]) continue;
    const int first = 3 * model_.bodies[b].first, count = 3 * model_.bodies[b].count;
    state_.x.segment(first, count) = before.x.segment(first, count);
    state_.v.segment(first, count).setZero();
  }
}

StepReport Simulation::step(double h) {
  if (sleep_ && sleep_->wake_moved(state_.x, state_.t, h)) change_sleepers();
  if (sleep_ && sleep_->all(state_.t, h)) {
    state_.t += h;
    StepReport report;
    report.steps = 1;
    return report;
  }
  const State before = state_;
  nominal_ = h;
  const double dissipated = dissipated_;
  double seconds = 0;
  StepReport report;
  {
    const Stopwatch watch(seconds);
    const int parts =
        std::max(1, static_cast<int>(std::ceil(pins_.turn(before.t, before.t + h) / kLargestTurn - 1e-9)));
    for (int part = 0; part < parts && report.converged; ++part) report.add(step_in_halves(h / parts, 0));
  }
  report.seconds.total = seconds;
  if (!report.converged) {
    state_ = before;
    dissipated_ = dissipated;
    forget();
  } else {
    // Parts of h do not add up to h exactly: frames fall where they should.
    state_.t = before.t + h;
    if (sleep_ && sleep_->settle(state_, h)) change_sleepers();
  }
  return report;
}

StepReport Simulation::step_in_halves(double h, int depth) {
  StepReport report = attempt(h);
  if (report.converged || depth == settings_.max_halvings) return report;
  report.steps = 0;
  ++report.retries;
  for (int half = 0; half < 2; ++half) {
    report.add(step_in_halves(h / 2, depth + 1));
    if (!report.converged) return report;
  }
  return report;
}

StepReport Simulation::attempt(double h) {
  const State before = state_;
  StepReport report = attempt_once(h, before);
  // What is touched in a step is awake in it; what stands in the way of a solution is, too.
  while (sleep_ && (report.converged ? sleep_->wake_touched(state_.x) : sleep_->wake_near())) {
    state_ = before;
    forget();
    change_sleepers();
    report.add(attempt_once(h, before));
  }
  if (!report.converged) {
    state_ = before;
    forget();
    return report;
  }
  report.steps = 1;
  const bool at_rest = implicit() && phi_->stage().a == 0;  // an equilibrium has no velocity
  if (!terms_.dissipations.empty() && !at_rest) {
    for (EnergyTerm* term : terms_.dissipations) report.dissipated += h * term->power(state_.v);
    dissipated_ += report.dissipated;
  }
  return report;
}

StepReport Simulation::attempt_once(double h, const State& before) {
  StepReport report;
  if (implicit())
    implicit_step(h, report);
  else
    explicit_step(h, report);
  if (sleep_ && sleep_->any()) keep_asleep(before);
  if (report.converged && model_.surfaces && !(implicit() && method_.implicit_method->ends_at_solution())) {
    const Stopwatch watch(report.seconds.contact);
    if (!model_.surfaces->way_is_free(before.x, before.t, state_.x, state_.t)) {
      report.converged = false;
      report.reason = model_.surfaces->blocking() + " would pass through each other";
    }
  }
  const bool at_rest = implicit() && phi_->stage().inertia == 0;  // there is no way in between
  if (report.converged && model_.contact && !at_rest) {
    const Stopwatch watch(report.seconds.contact);
    if (!model_.contact->way_is_free(before.x, before.t, state_.x, state_.t, pins_.fixed())) {
      report.converged = false;
      report.reason = at_collider() + " would pass through a collider";
    }
  }
  if (report.converged) {
    const double farthest = (state_.x - before.x).cwiseAbs().maxCoeff();
    if (!state_.x.allFinite() || !state_.v.allFinite() || !(farthest < kRunaway * extent_)) {
      report.converged = false;
      report.reason =
          implicit() ? "positions ran away" : "positions ran away: the step is too long for an explicit method";
    }
  }
  return report;
}

void Simulation::forget() {
  start_guess_.forget();
  if (implicit())
    method_.implicit_method->forget();
  else
    method_.explicit_method->forget();
}

StepContext Simulation::context(const State& from, const Eigen::VectorXd& predicted, double h, double t_forces) const {
  const double load = settings_.load_time > 0 ? std::min(1.0, t_forces / settings_.load_time) : 1.0;
  return {from.x, from.v, predicted, from.t, h, nominal_, t_forces, load};
}

void Simulation::begin_terms(const StepContext& context, StepReport& report) {
  for (EnergyTerm* term : terms_.potentials) {
    const Stopwatch watch(term->kind() == EnergyKind::kContact ? report.seconds.contact : report.seconds.gradient);
    term->begin_step(context);
  }
  const Stopwatch watch(report.seconds.gradient);
  for (EnergyTerm* term : terms_.dissipations) term->begin_step(context);
}

/// Forces at a state, with everything that is lagged in an implicit solve taken at that state itself.
Acceleration Simulation::acceleration(double h, StepReport& report) {
  const auto evaluate = [this, h, &report](State& at, Eigen::VectorXd& a) {
    if (pins_.any()) {
      pins_.place(at.t, at.x);
      pins_.drive(at.t, at.v);
    }
    begin_terms(context(at, at.x, h, at.t), report);
    a.setZero(at.x.size());
    for (const EnergyTerm* term : terms_.potentials) {
      const bool contact = term->kind() == EnergyKind::kContact;
      report.contact_evaluations += contact ? 1 : 0;
      const Stopwatch watch(contact ? report.seconds.contact : report.seconds.gradient);
      term->add_gradient(at.x, a);
    }
    const Stopwatch watch(report.seconds.gradient);
    for (const EnergyTerm* term : terms_.dissipations) term->add_gradient(at.v, a);
    a *= -1;
    (mass_ ? *mass_ : phi_->mass()).solve(a);
  };
  return {evaluate, !terms_.dissipations.empty()};
}

void Simulation::explicit_step(double h, StepReport& report) {
  method_.explicit_method->step(acceleration(h, report), h, state_);
  if (pins_.any()) {
    pins_.place(state_.t, state_.x);
    pins_.drive(state_.t, state_.v);
  }
}

Energies Simulation::energies() const {
  Energies e;
  e.kinetic = mass_ ? mass_->energy(state_.v) : phi_->mass().energy(state_.v);
  for (const auto& term : model_.potentials) {
    const double value = term->value(state_.x);
    if (term->kind() == EnergyKind::kElastic) e.elastic += value;
    if (term->kind() == EnergyKind::kGravity) e.gravity += value;
    if (term->kind() == EnergyKind::kContact) e.contact += value;
  }
  e.contact += resting_contact_;
  e.dissipated = dissipated_;
  return e;
}

void Simulation::contact_forces(Eigen::VectorXd& force) const {
  if (force.size() != state_.x.size()) force.setZero(state_.x.size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(state_.x.size());
  for (const auto& term : model_.potentials)
    if (term->kind() == EnergyKind::kContact) term->add_gradient(state_.x, gradient);
  for (std::size_t body = 0; body < model_.bodies.size(); ++body) {
    if (sleep_ && sleep_->asleep()[body] != 0) continue;
    const BodyRange& range = model_.bodies[body];
    force.segment(3 * range.first, 3 * range.count) = -gradient.segment(3 * range.first, 3 * range.count);
  }
}

std::vector<double> Simulation::memory() const {
  const std::vector<double> history =
      implicit() ? method_.implicit_method->memory() : method_.explicit_method->memory();
  std::vector<double> saved{dissipated_, static_cast<double>(history.size())};
  saved.insert(saved.end(), history.begin(), history.end());
  if (model_.surfaces) {
    const std::vector<double> contact = model_.surfaces->memory();
    saved.insert(saved.end(), contact.begin(), contact.end());
  }
  if (sleep_) {
    saved.push_back(resting_contact_);
    const std::vector<double> sleep = sleep_->memory();
    saved.insert(saved.end(), sleep.begin(), sleep.end());
  }
  if (minimizer_) {
    const std::vector<double> guess = start_guess_.memory();
    saved.insert(saved.end(), guess.begin(), guess.end());
    const std::vector<double> minimizer = minimizer_->memory();
    saved.insert(saved.end(), minimizer.begin(), minimizer.end());
  }
  return saved;
}

void Simulation::restore(const State& state, std::span<const double> memory) {
  const auto unfit = [] { throw std::invalid_argument("state or memory of another simulation"); };
  if (memory.size() < 2 || state.x.size() != model_.x0.size() || state.v.size() != model_.x0.size()) unfit();
  const auto history = static_cast<size_t>(memory[1]);
  if (memory.size() < 2 + history) unfit();
  state_ = state;
  dissipated_ = memory[0];
  if (implicit())
    method_.implicit_method->restore(memory.subspan(2, history));
  else
    method_.explicit_method->restore(memory.subspan(2, history));
  std::span<const double> rest = memory.subspan(2 + history);
  if (model_.surfaces) rest = model_.surfaces->restore(rest);
  if (sleep_) {
    if (rest.empty()) unfit();
    const double resting = rest[0];
    const bool slept = sleep_->any();
    rest = sleep_->restore(rest.subspan(1));
    if (slept || sleep_->any()) change_sleepers();
    resting_contact_ = resting;
  }
  if (minimizer_) minimizer_->restore(start_guess_.restore(rest, state.x.size()));
}

}  // namespace softreel::sim
