#pragma once
// TetGen's answer is believed only after it was checked.
#include <string>

#include "assets/tetgen_request.h"

namespace softreel::assets {

/// Takes the tets of `reply` that fill `surface` into `mesh`: cavities cleared, orientation positive, the surface's own
/// bits in its vertices, unused points dropped. Returns what is wrong, "" when all of this holds: there are tets, all
/// have volume, their boundary is the surface's faces, and their volume is `volume` [m^3] to 1e-6.
std::string accept_tets(const sim::TriangleMesh& surface, TetgenReply reply, double volume, sim::TetMesh& mesh);

}  // namespace softreel::assets
