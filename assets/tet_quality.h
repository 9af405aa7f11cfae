#pragma once
// How well-shaped the tetrahedra of a mesh are.
#include "sim/mesh.h"

namespace softreel::assets {

struct TetQuality {
  int tets = 0;
  int vertices = 0;
  double volume = 0;                                       ///< [m^3]
  double smallest_volume = 0, largest_volume = 0;          ///< of one tet [m^3]
  double worst_radius_ratio = 0, median_radius_ratio = 0;  ///< 3 r_in / r_circ: 1 regular, 0 flat
  double min_dihedral = 0, median_dihedral = 0,
         max_dihedral = 0;  ///< over all six angles of all tets [deg]; 70.53 regular
};

/// Radius ratio as in Shewchuk, "What is a good linear finite element?" (2002), section 6. `mesh` must not be empty.
TetQuality tet_quality(const sim::TetMesh& mesh);

/// Of one tetrahedron of `mesh`.
double radius_ratio(const sim::TetMesh& mesh, const sim::Tet& tet);

}  // namespace softreel::assets
