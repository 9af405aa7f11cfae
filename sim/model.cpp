#include "sim/model.h"

#include <algorithm>

namespace softreel::sim {

Pins::Pins(const Model& model) : model_(model), fixed_(3 * static_cast<size_t>(model.vertices()), 0) { fix(); }

void Pins::fix() {
  for (const Pin& pin : model_.pins)
    for (int v : pin.vertices)
      for (size_t axis = 0; axis < 3; ++axis)
        if (pin.axes[axis]) {
          fixed_[3 * static_cast<size_t>(v) + axis] = 1;
          any_ = true;
        }
}

void Pins::hold(std::span<const std::uint8_t> bodies) {
  std::fill(fixed_.begin(), fixed_.end(), 0);
  any_ = false;
  fix();
  for (size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]) continue;
    const auto first = fixed_.begin() + 3 * model_.bodies[b].first;
    std::fill(first, first + 3 * model_.bodies[b].count, 1);
    any_ = true;
  }
}

void Pins::place(double t, Eigen::VectorXd& x) const {
  for (const Pin& pin : model_.pins) {
    const Eigen::Isometry3d pose = pin.motion.pose(t);
    for (int v : pin.vertices) {
      const Eigen::Vector3d target = pose * model_.x0.segment<3>(3 * v);
      for (int axis = 0; axis < 3; ++axis)
        if (pin.axes[axis]) x(3 * v + axis) = target(axis);
    }
  }
}

void Pins::drive(double t, Eigen::VectorXd& v) const {
  for (const Pin& pin : model_.pins)
    for (int i : pin.vertices) {
      const Eigen::Vector3d velocity = pin.motion.velocity(t, model_.x0.segment<3>(3 * i));
      for (int axis = 0; axis < 3; ++axis)
        if (pin.axes[axis]) v(3 * i + axis) = velocity(axis);
    }
}

bool Pins::move(double from, double to) const {
  return std::any_of(model_.pins.begin(), model_.pins.end(),
                     [&](const Pin& pin) { return pin.motion.moves(from, to); });
}

double Pins::turn(double from, double to) const {
  double most = 0;
  for (const Pin& pin : model_.pins) most = std::max(most, pin.motion.turn(from, to));
  return most;
}

void Pins::zero(Eigen::VectorXd& vector) const {
  if (!any_) return;
  for (size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i]) vector(static_cast<Eigen::Index>(i)) = 0;
}

}  // namespace softreel::sim
