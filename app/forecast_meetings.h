#pragma once
// Which bodies may run into which colliders, and how fast.
#include <string>
#include <vector>

#include "app/forecast_edges.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/model.h"

namespace softreel::app {

/// A body and what its mesh shows.
struct MovingBody {
  const assets::Body* body = nullptr;
  const std::vector<sim::Vec3>* rest = nullptr;  ///< placed [m]
  Edges edges;
  std::vector<double> pin_speeds;  ///< the fastest that each pin drives any of its vertices [m/s]
  bool held = false;               ///< by pins or attachments: it does not fall
};

/// In the order of model.bodies.
std::vector<MovingBody> moving_bodies(const assets::Scene& scene, const Shapes& shapes, const sim::Model& model);

struct Meeting {
  const MovingBody* body = nullptr;
  const assets::Collider* collider = nullptr;
  double speed = 0;  ///< of one against the other, at most, as far as its own speed, driving and falling go [m/s]
};

/// Pairs whose boxes meet on the way: a free body falls and flies, one that is held swings by half its size. A collider
/// that stands where the body is pinned (a pole, a bar) is left out. `bodies` must outlive the result.
std::vector<Meeting> meetings_of(const assets::Scene& scene, const std::vector<MovingBody>& bodies,
                                 const sim::Model& model);

/// The radius of the largest ball that fits into the collider [m]; 0 for planes, which nothing passes around.
double inner_radius(const assets::Collider& collider);

}  // namespace softreel::app
