#pragma once
// What acts on bodies and between them: loads, attachments, wind.
#include <string>
#include <vector>

#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/model_builder.h"

namespace softreel::app {

/// A body that has been put into the model.
struct PlacedBody {
  std::string place;  ///< "soft.2": as in assets::BodyName
  std::string name;
  sim::BodyRange range;
  const std::vector<sim::Vec3>* rest = nullptr;  ///< placed [m]
  const sim::TetMesh* solid = nullptr;           ///< one of these two, or none
  const sim::TriangleMesh* sheet = nullptr;

  /// Vertices from 0, outward for solids; computed when it is asked for.
  std::vector<sim::Triangle> surface() const;
};

/// Adds to `builder` what the scene asks for. Throws UserError (kUsage) for a load or an attachment that finds nothing
/// where it looks, and says where the body is.
void add_couplings(const assets::Scene& scene, const std::vector<PlacedBody>& bodies, sim::ModelBuilder& builder);

}  // namespace softreel::app
