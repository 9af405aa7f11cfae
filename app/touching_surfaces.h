#pragma once
// Which surfaces of a scene touch each other: bodies, themselves, mesh colliders.
#include <vector>

#include "app/couplings.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/contact/surface_contact.h"
#include "sim/model_builder.h"

namespace softreel::app {

/// Hands the surfaces to `builder`, if there is contact between any. Bodies that are tied together do not touch, unless
/// a pair of [contact] says that they do.
void add_touching_surfaces(const assets::Scene& scene, const Shapes& shapes, const std::vector<PlacedBody>& bodies,
                           sim::ModelBuilder& builder);

/// Triangles of touching surfaces that cross each other in a state, pairs that may not touch left out.
struct Crossing {
  int first = 0, second = 0;  ///< surfaces
  long pairs = 0;             ///< of triangles
};
std::vector<Crossing> crossings(const sim::ContactSurfaces& surfaces, const Eigen::VectorXd& x, double t);

/// A first frame in which surfaces cross, or lie inside a soft body, is refused (UserError, kUsage, with the pairs), or
/// bodies are moved apart if the scene
/// asks for it: `model` then begins without any. Moved are bodies without pins, as a whole, pair by pair the least way
/// that is found (way_apart.h); what cannot be resolved so is refused.
void settle_overlaps(const assets::Scene& scene, sim::Model& model);

}  // namespace softreel::app
