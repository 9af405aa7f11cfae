#include "sim/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sim/explicit_method.h"
#include "sim/implicit_method.h"
#include "sim/method_table.h"
#include "sim/parallel.h"
#include "sim/stopwatch.h"

namespace softreel::sim {
namespace {

struct Entry {
  MethodInfo info;
  std::unique_ptr<ImplicitMethod> (*make_implicit)();
  std::unique_ptr<ExplicitMethod> (*make_explicit)();
};

template <class Method>
constexpr Entry implicit_entry(const MethodInfo& info) {
  return {info, []() -> std::unique_ptr<ImplicitMethod> { return std::make_unique<Method>(); }, nullptr};
}
template <class Method>
constexpr Entry explicit_entry(const MethodInfo& info) {
  return {info, nullptr, []() -> std::unique_ptr<ExplicitMethod> { return std::make_unique<Method>(); }};
}

// The one table of integrators.
constexpr std::array kIntegrators = {
    implicit_entry<ImplicitEuler>({"implicit-euler", "never gains energy; damps motion faster than a few steps",
                                   "one minimization a step", "Baraff, Witkin 1998", 1}),
    explicit_entry<SymplecticEuler>({"symplectic-euler", "velocity first; stable while h omega < 2",
                                     "one gradient a step", "Hairer, Lubich, Wanner 2006, section I.1.2", 1}),
};

const Entry& find(std::string_view name) { return find_method(kIntegrators, name, "integrator"); }

// A vertex that crosses so many times the scene in one step is not simulated any more.
constexpr double kRunaway = 100;

}  // namespace

Catalogue integrators() { return catalogue_of<kIntegrators>(); }

bool is_implicit(std::string_view integrator) { return find(integrator).make_implicit != nullptr; }

Simulation::Simulation(Model model, const SimulationSettings& settings)
    : model_(std::move(model)), pins_(model_), settings_(settings), state_{0, model_.x0, model_.v0} {
  pins_.zero(state_.v);  // a body's velocity is not that of what holds it
  const Entry& entry = find(settings.integrator);
  if (entry.make_implicit) {
    implicit_ = entry.make_implicit();
    phi_ = std::make_unique<IncrementalPotential>(model_, pins_);
    newton_ = std::make_unique<Newton>(model_, *phi_, settings.linear_solver, settings.newton);
  } else {
    explicit_ = entry.make_explicit();
  }
  if (model_.vertices() > 0) {
    const Eigen::Map<const Eigen::Matrix3Xd> x(model_.x0.data(), 3, model_.vertices());
    extent_ = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  }
  extent_ = std::max(extent_, 1.0);
}

Simulation::~Simulation() = default;

StepReport Simulation::step(double h) {
  const State before = state_;
  nominal_ = h;
  const double dissipated = dissipated_;
  double seconds = 0;
  StepReport report;
  {
    const Stopwatch watch(seconds);
    report = step_in_halves(h, 0);
  }
  report.seconds.total = seconds;
  if (!report.converged) {
    state_ = before;
    dissipated_ = dissipated;
  } else {
    // n halves of h do not add up to h exactly: frames fall where they should.
    state_.t = before.t + h;
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
  StepReport report;
  State before = state_;
  if (implicit_)
    implicit_step(h, report);
  else
    explicit_step(h, report);
  if (report.converged) {
    const double farthest = (state_.x - before.x).cwiseAbs().maxCoeff();
    if (!state_.x.allFinite() || !state_.v.allFinite() || !(farthest < kRunaway * extent_)) {
      report.converged = false;
      report.reason =
          implicit_ ? "positions ran away" : "positions ran away: the step is too long for an explicit method";
    }
  }
  if (!report.converged) {
    state_ = std::move(before);
    return report;
  }
  report.steps = 1;
  if (!model_.dissipations.empty()) {
    for (const auto& term : model_.dissipations) report.dissipated += h * term->power(state_.v);
    dissipated_ += report.dissipated;
  }
  return report;
}

void Simulation::begin_step(double h, StepReport& report) {
  predicted_ = state_.x + h * state_.v;
  const StepContext context{state_.x, state_.v, predicted_, state_.t, h, nominal_};
  for (const auto& term : model_.potentials) {
    const Stopwatch watch(term->kind() == EnergyKind::kContact ? report.seconds.contact : report.seconds.gradient);
    term->begin_step(context);
  }
  for (const auto& term : model_.dissipations) term->begin_step(context);
}

void Simulation::implicit_step(double h, StepReport& report) {
  begin_step(h, report);
  implicit_->predict(state_, h, phi_->stage());
  // Two places to start from: where the vertices are and where they are heading. The lower of the two is nearer: in
  // free motion the second, before an impact the first.
  Eigen::VectorXd y = predicted_;
  pins_.place(state_.t + h, y);
  if (model_.contact) {
    Eigen::VectorXd here = state_.x;
    pins_.place(state_.t + h, here);
    if (phi_->value(here, report) < phi_->value(y, report)) y.swap(here);
  }
  newton_->minimize(y, report);
  if (report.converged) implicit_->finish(y, h, state_);
}

void Simulation::explicit_step(double h, StepReport& report) {
  begin_step(h, report);
  const Acceleration acceleration = [&](const State& at, Eigen::VectorXd& a) {
    a.setZero(at.x.size());
    for (const auto& term : model_.potentials) {
      const bool contact = term->kind() == EnergyKind::kContact;
      report.contact_evaluations += contact ? 1 : 0;
      const Stopwatch watch(contact ? report.seconds.contact : report.seconds.gradient);
      term->add_gradient(at.x, a);
    }
    for (const auto& term : model_.dissipations) term->add_gradient(at.v, a);
    parallel_for(model_.vertices(), Work::kVector, [&](int i) { a.segment<3>(3 * i) /= -model_.masses(i); });
    pins_.zero(a);
  };
  const Eigen::VectorXd x = state_.x;
  explicit_->step(acceleration, h, state_);
  if (pins_.any()) {
    pins_.place(state_.t, state_.x);
    for (size_t i = 0; i < pins_.fixed().size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (pins_.fixed()[i]) state_.v(k) = (state_.x(k) - x(k)) / h;
    }
  }
}

Energies Simulation::energies() const {
  Energies e;
  e.kinetic = 0.5 * parallel_sum(model_.vertices(), Work::kVector,
                                 [&](int i) { return model_.masses(i) * state_.v.segment<3>(3 * i).squaredNorm(); });
  for (const auto& term : model_.potentials) {
    const double value = term->value(state_.x);
    if (term->kind() == EnergyKind::kElastic) e.elastic += value;
    if (term->kind() == EnergyKind::kGravity) e.gravity += value;
    if (term->kind() == EnergyKind::kContact) e.contact += value;
  }
  e.dissipated = dissipated_;
  return e;
}

std::vector<double> Simulation::memory() const {
  std::vector<double> saved{dissipated_};
  if (newton_) {
    const std::vector<double> linear = newton_->linear_solver().memory();
    saved.insert(saved.end(), linear.begin(), linear.end());
  }
  return saved;
}

void Simulation::restore(const State& state, std::span<const double> memory) {
  if (memory.empty()) throw std::invalid_argument("memory of another simulation");
  state_ = state;
  dissipated_ = memory[0];
  if (newton_) {
    newton_->prepare();
    newton_->linear_solver().restore(memory.subspan(1));
  }
}

}  // namespace softreel::sim
