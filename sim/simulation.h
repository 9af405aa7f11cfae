#pragma once
// A running simulation: a model, an integrator, and the state that it moves.
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/catalogue.h"
#include "sim/incremental_potential.h"
#include "sim/integrators.h"
#include "sim/minimizer.h"
#include "sim/model.h"
#include "sim/sleep.h"
#include "sim/start_guess.h"
#include "sim/step_report.h"
#include "sim/term_list.h"

namespace softreel::sim {

struct SimulationSettings {
  std::string integrator = "implicit-euler";  ///< of `integrators()`
  LinearSettings linear_solver;
  MinimizerSettings minimizer;
  int max_halvings = 6;    ///< a step that does not converge is retried in halves, so many times over
  double sleep_speed = 0;  ///< bodies that stay slower fall asleep (sleep.h) [m/s]; 0: none does
  double load_time = 0;    ///< of a static analysis: when gravity and loads have grown to their full size [s]
};

/// Energies of the whole scene [J].
struct Energies {
  double kinetic = 0, elastic = 0, gravity = 0, contact = 0;  ///< gravity: and dead loads
  /// What dissipation potentials have taken out of the motion since the start, less what wind has put in; the method's
  /// own damping is not in it.
  double dissipated = 0;
};

class Simulation {
 public:
  /// Throws std::invalid_argument for unknown names.
  Simulation(Model model, const SimulationSettings& settings);
  ~Simulation();

  const Model& model() const { return model_; }
  const State& state() const { return state_; }
  bool implicit() const { return method_.implicit_method != nullptr; }

  /// Goes on by h [s] > 0. If the report says that it did not converge, the state is what it was before, and methods
  /// that keep earlier steps start anew from it.
  ///
  /// A step in which a pin turns by more than 90 degrees is taken in as many equal ones as it needs: beyond 180 the
  /// straight way of the pinned vertices goes through the body, which would end untwisted, wrong and calm.
  StepReport step(double h);

  Energies energies() const;
  /// What contact does to the vertices now, friction left out, 3n [N]. `force`: entries of bodies that are asleep stay
  /// as they are (contact among these is not looked at); its size is set where it does not fit.
  void contact_forces(Eigen::VectorXd& force) const;
  /// How many bodies are asleep.
  bool sleeps() const { return sleep_ != nullptr; }  ///< can any fall asleep?
  int asleep() const { return sleep_ ? sleep_->count() : 0; }

  /// Everything beside the state that later steps depend on; `restore` goes on from it with the same bits.
  std::vector<double> memory() const;
  void restore(const State& state, std::span<const double> memory);

 private:
  StepReport attempt(double h);
  StepReport attempt_once(double h, const State& before);
  void arrange();
  void change_sleepers();
  void keep_asleep(const State& before);
  StepReport step_in_halves(double h, int depth);
  StepContext context(const State& from, const Eigen::VectorXd& predicted, double h, double t_forces) const;
  void begin_terms(const StepContext& context, StepReport& report);
  Acceleration acceleration(double h, StepReport& report);
  void explicit_step(double h, StepReport& report);
  void implicit_step(double h, StepReport& report);
  double free_share(const Eigen::VectorXd& move) const;
  double start_of_solve(double end, const Eigen::VectorXd& target, Eigen::VectorXd& y, StepReport& report);
  std::string at_collider() const;
  void solve(const Eigen::VectorXd& target, double progress, const Eigen::VectorXd* guess, Eigen::VectorXd& y,
             StepReport& report);
  void forget();

  Model model_;
  Pins pins_;
  TermList terms_;                ///< of what is awake
  std::unique_ptr<Sleep> sleep_;  ///< null: nothing ever falls asleep
  double resting_contact_ = 0;    ///< energy of contact between what is asleep [J]
  SimulationSettings settings_;
  State state_;
  double dissipated_ = 0;
  double nominal_ = 0;  ///< the step that was asked for [s]
  double extent_ = 0;   ///< diagonal of the scene at the start [m]
  Integrator method_;
  std::unique_ptr<IncrementalPotential> phi_;  // of implicit methods
  std::unique_ptr<Minimizer> minimizer_;
  std::unique_ptr<MassMatrix> mass_;  // of explicit methods
  bool driven_ = false;               ///< with contact between surfaces: pins or colliders of it move in this step
  Eigen::VectorXd predicted_, guess_;
  StartGuess start_guess_;  // of implicit methods
};

}  // namespace softreel::sim
