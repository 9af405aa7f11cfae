#pragma once
// From the scene's description of a field to what is simulated.
#include <vector>

#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/field.h"

namespace softreel::app {

/// As scene.fields. Throws UserError (kUsage) for what only the meshes show to be wrong: fixed values that hold no
/// vertex, poisson without any on some piece, a formula that is not finite somewhere, a step that is too long for an
/// explicit method (with the substeps that hold).
std::vector<sim::Field> build_fields(const assets::Scene& scene, const Shapes& shapes);

/// Steps between two frames with which the explicit time.integrator holds on all of them; 1 if any number does. Throws
/// UserError (kUsage) if no number does.
double field_steps_per_frame(const assets::Scene& scene, const std::vector<sim::Field>& fields);

}  // namespace softreel::app
