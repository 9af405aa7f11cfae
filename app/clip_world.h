#pragma once
// A scene while it is simulated: its bodies and fields, stepped together.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/clip_cache.h"
#include "app/momentum_watch.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/field.h"
#include "sim/simulation.h"
#include "sim/step_report.h"

namespace softreel::app {

/// Why a step did not hold.
struct StepFailure {
  std::string why;      ///< for the user
  bool halved = false;  ///< it was tried in halves, too
};

/// Bodies and fields of a scene; what it does not have is not built.
class ClipWorld {
 public:
  /// At t = 0. Throws UserError as build_model and build_fields do. `scene` must outlive this.
  ClipWorld(const assets::Scene& scene, const Shapes& shapes);

  int vertices() const { return bodies_ ? bodies_->model().vertices() : 0; }
  const sim::Simulation* bodies() const { return bodies_.get(); }  ///< null: the scene has none
  const std::vector<sim::Field>& fields() const { return fields_; }
  double time() const { return t_; }  ///< [s]

  /// Goes on by h [s] > 0 and adds to `sum` what it took. Tells why, when the step did not hold.
  std::optional<StepFailure> step(double h, sim::StepReport& sum);

  /// The present state; `sum`: of the steps since the frame before.
  CachedFrame frame(const sim::StepReport& sum) const;
  void restore(const CachedFrame& frame);

 private:
  ContactFigures contact_figures(const sim::StepReport& sum) const;

  const assets::Scene& scene_;
  bool shows_pressure_ = false;
  mutable Eigen::VectorXd contact_force_;  // kept from frame to frame for what is asleep
  double t_ = 0;
  std::unique_ptr<sim::Simulation> bodies_;
  std::optional<MomentumWatch> momentum_;  // where it is kept
  std::vector<sim::Field> fields_;
};

}  // namespace softreel::app
