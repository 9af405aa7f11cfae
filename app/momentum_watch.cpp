#include "app/momentum_watch.h"

#include <algorithm>
#include <cmath>

#include "assets/scene_contact.h"

namespace softreel::app {

using sim::Vec3;

bool keeps_momentum(const assets::Scene& s) {
  const auto free = [](const auto& bodies) {
    return std::all_of(bodies.begin(), bodies.end(), [](const assets::Body& b) {
      return b.pins.empty() && b.mass != assets::MassModel::kConsistent;
    });
  };
  return s.time.integrator != "static" && s.colliders.empty() && s.loads.empty() && !s.wind && s.damping.drag == 0 &&
         s.damping.alpha == 0 && assets::sleep_speed(s) == 0 && free(s.soft) && free(s.cloth) && free(s.springs);
}

MomentumWatch::MomentumWatch(const sim::Model& model, const Vec3& gravity)
    : model_(model), gravity_(gravity), first_(momentum(model.v0)), mass_(model.masses.sum()) {}

Vec3 MomentumWatch::momentum(const Eigen::VectorXd& v) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < model_.vertices(); ++i) sum += model_.masses(i) * v.segment<3>(3 * i);
  return sum;
}

double MomentumWatch::drift(const sim::State& state, const sim::Energies& e) const {
  const Vec3 given = mass_ * state.t * gravity_;
  const double scale = std::sqrt(2 * mass_ * (e.kinetic + e.elastic + e.contact)) + given.norm();
  return scale > 0 ? (momentum(state.v) - first_ - given).norm() / scale : 0;
}

}  // namespace softreel::app
