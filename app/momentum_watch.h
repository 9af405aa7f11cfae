#pragma once
// Total momentum, which only what acts from outside changes.
#include "assets/scene.h"
#include "sim/simulation.h"

namespace softreel::app {

/// Does nothing but gravity act on the scene's bodies from outside? Of lumped masses only, over which momenta are
/// summed, and not of equilibria, which have none.
bool keeps_momentum(const assets::Scene& scene);

/// Every integrator keeps total momentum to rounding if its steps are solved exactly: what is missing tells how far the
/// solves are from that.
class MomentumWatch {
 public:
  /// `model` must outlive this. `gravity` [m/s^2].
  MomentumWatch(const sim::Model& model, const sim::Vec3& gravity);

  /// |M v - M (v0 + g t)| over what masses and energies of this size could have: sqrt(2 M (kinetic + elastic +
  /// contact)) + M |g| t [-]. 0 where nothing moves.
  double drift(const sim::State& state, const sim::Energies& energies) const;

 private:
  sim::Vec3 momentum(const Eigen::VectorXd& v) const;  // [kg m/s]

  const sim::Model& model_;
  sim::Vec3 gravity_, first_;
  double mass_;
};

}  // namespace softreel::app
