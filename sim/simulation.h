#pragma once
// A running simulation: a model, an integrator, and the state that it moves.
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/catalogue.h"
#include "sim/model.h"
#include "sim/newton.h"
#include "sim/step_report.h"

namespace softreel::sim {

class ImplicitMethod;
class ExplicitMethod;

struct SimulationSettings {
  std::string integrator = "implicit-euler";
  std::string linear_solver = "auto";
  NewtonSettings newton;
  int max_halvings = 6;  ///< a step that does not converge is retried in halves, so many times over
};

/// Energies of the whole scene [J].
struct Energies {
  double kinetic = 0, elastic = 0, gravity = 0, contact = 0;
  double dissipated = 0;  ///< by dissipation potentials, since the start; the method's own damping is not in it
};

class Simulation {
 public:
  /// Throws std::invalid_argument for unknown names.
  Simulation(Model model, const SimulationSettings& settings);
  ~Simulation();

  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  bool implicit() const { return implicit_ != nullptr; }

  /// Goes on by h [s] > 0. If the report says that it did not converge, the state is what it was before.
  StepReport step(double h);

  Energies energies() const;

  /// Everything beside the state that later steps depend on; `restore` goes on from it with the same bits.
  std::vector<double> memory() const;
  void restore(const State& state, std::span<const double> memory);

 private:
  StepReport attempt(double h);
  StepReport step_in_halves(double h, int depth);
  void begin_step(double h, StepReport& report);
  void explicit_step(double h, StepReport& report);
  void implicit_step(double h, StepReport& report);

  Model model_;
  Pins pins_;
  SimulationSettings settings_;
  State state_;
  double dissipated_ = 0;
  double nominal_ = 0;  ///< the step that was asked for [s]
  double extent_ = 0;   ///< diagonal of the scene at the start [m]
  std::unique_ptr<ImplicitMethod> implicit_;
  std::unique_ptr<ExplicitMethod> explicit_;
  std::unique_ptr<IncrementalPotential> phi_;
  std::unique_ptr<Newton> newton_;
  Eigen::VectorXd predicted_;
};

/// True if the integrator solves a system each step.
bool is_implicit(std::string_view integrator);

}  // namespace softreel::sim
