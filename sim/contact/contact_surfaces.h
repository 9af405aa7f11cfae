#pragma once
// The surfaces that touch each other: of bodies, and of mesh colliders that follow a script.
#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "sim/mesh.h"
#include "sim/motion.h"

namespace softreel::sim {

/// One surface as it is handed in.
struct SurfaceInput {
  std::string name;
  int first_vertex = 0;             ///< of the body in the state; -1: a collider, moved by `motion`
  std::vector<Vec3> vertices;       ///< of the whole body at rest [m]
  std::vector<Triangle> triangles;  ///< indices of `vertices`; vertices without a triangle take no part
  Motion motion;                    ///< of a collider
  double thickness = 0;             ///< surfaces keep half of it on either side [m] >= 0
  double friction = 0;              ///< Coulomb's coefficient >= 0
  bool self = false;                ///< does it touch itself?
  bool others = true;               ///< does it touch others?
};

/// What holds for two surfaces, or for one with itself, instead of what follows from each of them.
struct SurfacePairRule {
  int a = 0, b = 0;  ///< numbers of surfaces
  bool touch = true;
  double friction = -1;   ///< < 0: as it follows
  double thickness = -1;  ///< their whole distance [m]; < 0: as it follows
  /// Tied together: what is nearer at rest than they come to touch is left alone.
  bool tied = false;
};

struct ContactSurface {
  std::string name;
  int first = 0, count = 0;                    ///< vertices
  int first_triangle = 0, triangle_count = 0;  ///< triangles
  double half_thickness = 0;                   ///< [m]
  double friction = 0;
  bool collider = false;
  Motion motion;
};

/// Two surfaces (or one) that can touch.
struct SurfacePair {
  int a = 0, b = 0;            ///< a <= b
  double friction = 0;         ///< the geometric mean of the two, if no rule says otherwise
  double offset = 0;           ///< distance at which they touch [m]
  bool close_at_rest = false;  ///< of one body, or tied: distances at rest count
};

/// All contact surfaces in one numbering of vertices, triangles and edges, surface by surface.
class ContactSurfaces {
 public:
  /// Throws std::invalid_argument for a triangle with vertices that are not there.
  ContactSurfaces(const std::vector<SurfaceInput>& inputs, std::span<const SurfacePairRule> rules);

  std::vector<ContactSurface> surfaces;
  std::vector<SurfacePair> pairs;  ///< of surfaces that can touch
  std::vector<int> state_vertex;   ///< per vertex: its number in the state; -1 of a collider
  std::vector<int> surface_of;     ///< per vertex
  std::vector<Vec3> rest;          ///< per vertex [m]
  std::vector<Triangle> triangles;
  std::vector<std::array<int, 2>> edges;
  /// Per triangle: its three edges, and which of its vertices (bits 0 to 2) and edges (bits 3 to 5) it stands for:
  /// each vertex and edge has one triangle that does (Curtis, Tamstorf, Manocha 2008, "Fast collision detection for
  /// deformable models using representative-triangles").
  std::vector<std::array<int, 3>> triangle_edges;
  std::vector<std::uint8_t> stands_for;

  int vertices() const { return static_cast<int>(rest.size()); }
  bool any() const { return !pairs.empty(); }
  /// Is any collider elsewhere at `to` than at `from` [s]?
  bool colliders_move(double from, double to) const;

  /// Positions of all vertices [m]: from x (3n) of the state; colliders between their places at two times.
  struct ColliderPath {
    std::vector<Vec3> from, to;  ///< of the colliders' vertices, in order
  };
  ColliderPath collider_path(double t_from, double t_to) const;
  void gather(const Eigen::VectorXd& x, const ColliderPath& path, double progress, std::vector<Vec3>& positions) const;
  /// Displacements of all vertices for a move dx (3n) of the state, while colliders go `advance` of their path.
  void gather_move(const Eigen::VectorXd& dx, const ColliderPath& path, double advance, std::vector<Vec3>& moves) const;
};

}  // namespace softreel::sim
