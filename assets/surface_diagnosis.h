#pragma once
// What is wrong with a surface that should enclose a volume, and where.
#include <string>
#include <vector>

#include "sim/mesh.h"

namespace softreel::assets {

/// Something counted, with the places of the first few.
struct Defect {
  int count = 0;
  std::vector<sim::Vec3> where;  ///< the first few, at most kDefectPlaces [m]
};
constexpr int kDefectPlaces = 3;

struct SurfaceDiagnosis {
  Defect open_edges;             ///< edges with one face
  int boundary_loops = 0;        ///< connected groups of open edges: holes
  Defect non_manifold_edges;     ///< edges with three or more faces
  Defect non_manifold_vertices;  ///< vertices whose faces form more than one fan (edges above not counted again)
  Defect flipped_edges;          ///< edges whose two faces run the same way: orientation changes across them
  Defect inside_out;             ///< closed components that face inwards without lying inside another one
  Defect nested;                 ///< closed components that lie inside another one and face outwards as well
  Defect crossings;              ///< pairs of faces that cross, touch or overlap beyond a shared vertex or edge
  Defect zero_area;              ///< faces without area
  Defect duplicates;             ///< faces with the same three vertices as an earlier one
  Defect unused_vertices;        ///< vertices of no face
  int components = 0;            ///< connected by shared vertices
  double volume = 0;             ///< signed enclosed volume [m^3]; meaningful where closed
  double area = 0;               ///< [m^2]

  /// Closed, manifold, consistently oriented outwards, free of crossings: it bounds a solid.
  bool bounds_solid() const;
};

/// Crossings are decided with exact predicates on the double coordinates, so there is no tolerance to choose.
/// O(n log n) for surfaces that are not pathologically dense; counting stops at `max_crossings` pairs.
SurfaceDiagnosis diagnose_surface(const sim::TriangleMesh& mesh, int max_crossings = 100000);

/// One sentence for the user: what is wrong and where, the worst first; "" where nothing is.
std::string describe(const SurfaceDiagnosis& diagnosis);

}  // namespace softreel::assets
