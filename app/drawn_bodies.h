#pragma once
// What of a scene is drawn, in the order of the state, with what it is drawn as.
#include "app/shapes.h"
#include "assets/scene.h"
#include "render/surface_mesh.h"

namespace softreel::app {

/// Calls each(body, drawn surface, first vertex, is cloth) in the order of the state.
template <class Each>
void for_each_body(const assets::Scene& scene, const Shapes& shapes, const Each& each) {
  int first = 0;
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    each(static_cast<const assets::Body&>(scene.soft[i]), shapes.soft[i].drawn, first, false);
    first += static_cast<int>(shapes.soft[i].rest.vertices.size());
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i) {
    each(static_cast<const assets::Body&>(scene.cloth[i]), shapes.cloth[i].drawn, first, true);
    first += static_cast<int>(shapes.cloth[i].rest.vertices.size());
  }
}

/// Calls each(body, drawn shape, first vertex) for visible bodies of springs, which come after the others in the state.
template <class Each>
void for_each_net(const assets::Scene& scene, const Shapes& shapes, const Each& each) {
  int first = 0;
  for (const SolidShape& s : shapes.soft) first += static_cast<int>(s.rest.vertices.size());
  for (const ClothShape& c : shapes.cloth) first += static_cast<int>(c.rest.vertices.size());
  for (size_t i = 0; i < scene.springs.size(); ++i) {
    if (shapes.springs[i].drawn) each(scene.springs[i], *shapes.springs[i].drawn, first);
    first += static_cast<int>(shapes.springs[i].rest.size());
  }
}

/// What a collider that is no mesh is drawn as; a plane as a sheet of `side` [m].
render::Shape shape_of(const assets::Collider& collider, float side);

}  // namespace softreel::app
