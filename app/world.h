#pragma once
// From the scene's description to what is simulated.
#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/collider.h"
#include "sim/simulation.h"

namespace softreel::app {

/// Bodies in the order soft, cloth, springs. Throws UserError (kUsage) for what only the meshes show to be wrong: a pin
/// that holds no vertex, a load that finds nothing, a mesh with flat triangles for a cloth.
sim::Model build_model(const assets::Scene& scene, const Shapes& shapes);

sim::SimulationSettings simulation_settings(const assets::Scene& scene);

/// Does some body show the pressure of contact, which only the running simulation knows?
bool shows_pressure(const assets::Scene& scene);

sim::Collider make_collider(const assets::Collider& collider);

}  // namespace softreel::app
