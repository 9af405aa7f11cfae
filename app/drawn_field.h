#pragma once
// A field as it is drawn: coloured by its values, displaced by them if asked.
#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "app/shapes.h"
#include "assets/scene.h"
#include "render/color_bar.h"
#include "render/look.h"

namespace softreel::app {

/// The surface that a field is drawn on.
class FieldSurface {
 public:
  FieldSurface(const assets::Field& field, const ClothShape& shape);

  /// Vertices at these values: rest + height value normal [m].
  std::vector<sim::Vec3> points(const Eigen::VectorXd& value) const;
  std::vector<glm::vec3> positions(const Eigen::VectorXd& value) const;

 private:
  double height_;
  std::vector<sim::Vec3> rest_;
  std::vector<sim::Vec3> normals_;  ///< of unit length, weighted by area; empty where nothing is displaced
};

/// Lowest and highest value over the frames that were added.
struct FieldRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const Eigen::VectorXd& value);
};

/// Values of the first and last colour: the scene's, or what the clip covers; for a map with a middle the same on both
/// sides of zero. Always low < high.
std::array<double, 2> color_range(const std::optional<std::array<double, 2>>& range, assets::ColorMap map,
                                  const FieldRange& covered);

/// Values as places in the colour map, 0..1 within `range`.
std::vector<float> map_places(const Eigen::VectorXd& value, const std::array<double, 2>& range);

render::Look field_look(const assets::Field& field);
render::ColorBar color_bar(const assets::Field& field, const std::array<double, 2>& range);

}  // namespace softreel::app
