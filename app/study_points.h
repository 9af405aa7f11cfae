#pragma once
// Material points at which variants are compared, whatever their meshes.
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "app/shapes.h"
#include "assets/scene.h"

namespace softreel::app {

/// The vertices of the scene as it is, of all bodies or of one.
struct StudyPoints {
  struct Body {
    enum class Kind { kSoft, kCloth, kSprings } kind;
    size_t index;                 ///< in scene.soft, .cloth or .springs
    std::vector<sim::Vec3> rest;  ///< placed [m]
    int first;                    ///< vertex of the scene's own state
  };
  std::vector<Body> bodies;
  size_t count() const;
};

/// `place`: "soft.2", only that body; empty: all.
StudyPoints study_points(const assets::Scene& scene, const Shapes& shapes, const std::string& place);

/// The points as combinations of the vertices of a variant's state.
class PointMap {
 public:
  /// A point that is no vertex of the variant lies in the nearest tetrahedron, triangle or edge of its body at rest.
  PointMap(const StudyPoints& points, const Shapes& shapes);

  /// `x`: a state of the variant, 3n [m]; returns 3 x count [m].
  Eigen::Matrix3Xd at(const Eigen::VectorXd& x) const;

 private:
  struct Combination {
    std::array<int, 4> vertices;
    std::array<double, 4> weights;  // sum 1; those of a vertex are 1, 0, 0, 0
  };
  std::vector<Combination> combinations_;
};

}  // namespace softreel::app
