#pragma once
// What tests of whole simulations have in common.
#include <doctest/doctest.h>

#include <vector>

#include "sim/mesh.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

namespace softreel::tests {

inline sim::Pin pin_where(const std::vector<sim::Vec3>& vertices, const auto& inside) {
  sim::Pin pin;
  for (size_t i = 0; i < vertices.size(); ++i)
    if (inside(vertices[i])) pin.vertices.push_back(static_cast<int>(i));
  return pin;
}

inline sim::Vec3 centre_of_mass(const sim::Simulation& s) {
  sim::Vec3 sum = sim::Vec3::Zero();
  for (int i = 0; i < s.model().vertices(); ++i) sum += s.model().masses(i) * s.state().x.segment<3>(3 * i);
  return sum / s.model().masses.sum();
}

inline sim::Vec3 momentum(const sim::Simulation& s) {
  sim::Vec3 sum = sim::Vec3::Zero();
  for (int i = 0; i < s.model().vertices(); ++i) sum += s.model().masses(i) * s.state().v.segment<3>(3 * i);
  return sum;
}

/// About the origin.
inline sim::Vec3 angular_momentum(const sim::Simulation& s) {
  sim::Vec3 sum = sim::Vec3::Zero();
  for (int i = 0; i < s.model().vertices(); ++i)
    sum += s.model().masses(i) * s.state().x.segment<3>(3 * i).cross(s.state().v.segment<3>(3 * i));
  return sum;
}

inline double total_energy(const sim::Simulation& s) {
  const sim::Energies e = s.energies();
  return e.kinetic + e.elastic + e.gravity + e.contact;
}

inline void must_step(sim::Simulation& s, double h, int steps) {
  for (int i = 0; i < steps; ++i) {
    const sim::StepReport r = s.step(h);
    REQUIRE_MESSAGE(r.converged, r.reason);
  }
}

/// Solves as exactly as rounding allows, so that only the integrator's error is seen.
inline sim::SimulationSettings exact(const std::string& integrator) {
  sim::SimulationSettings settings{integrator, "cholesky", {}, 0};
  settings.minimizer.tolerance = 1e-13;
  return settings;
}

}  // namespace softreel::tests
