#pragma once
// A figure of the simulation at the vertices of a body: what a scene's `data` shows.
#include <memory>
#include <string>
#include <vector>

#include "app/clip_cache.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "sim/energy_term.h"
#include "sim/state.h"

namespace softreel::app {

class BodyFigure {
 public:
  /// `first`: the body's first vertex in the state.
  BodyFigure(const assets::SoftBody& body, const SolidShape& shape, int first);
  BodyFigure(const assets::Cloth& cloth, const ClothShape& shape, int first);

  /// Per vertex of the body. Strain and stress are those of the adjacent elements, weighted by their rest size.
  /// Contact pressure is the force that contact adds to the vertex over its share of the surface as it is now; where a
  /// cloth is touched from both sides the forces cancel.
  Eigen::VectorXd values(const CachedFrame& frame) const;

 private:
  /// Corners of an element at rest, as columns beside the first one, and its size.
  struct Element {
    std::array<int, 4> vertices{};  // of the body
    Eigen::Matrix3d rest;           // columns; of a triangle two, and the unit normal
    double size = 0;                // [m^3], or of a cloth [m^2] times thickness
  };
  void add_element(const std::vector<sim::Vec3>& rest, std::array<int, 4> vertices, double thickness);
  Eigen::VectorXd pressure(const CachedFrame& frame) const;
  Eigen::Matrix3d edges(const sim::State& state, const Element& element) const;

  assets::Quantity show_;
  int first_, count_, corners_;
  std::vector<Element> elements_;
  std::vector<sim::Triangle> surface_;  // of the body; for pressure
  /// All elements side by side, none of which shares a vertex: its gradient holds each one's own forces. For stress.
  std::unique_ptr<sim::EnergyTerm> apart_;
};

/// "Speed [m/s]".
std::string figure_label(assets::Quantity show);

}  // namespace softreel::app
