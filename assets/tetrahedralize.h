#pragma once
// A closed surface becomes tetrahedra through TetGen (Hang Si, "TetGen, a Delaunay-based quality tetrahedral mesh
// generator", ACM TOMS 41(2), 2015), in a worker process with a time limit (see worker.h).
#include <filesystem>
#include <functional>
#include <string>

#include "sim/mesh.h"

namespace softreel::assets {

struct TetrahedralizeOptions {
  double quality =
      1.4;  ///< largest ratio of circumradius to shortest edge, >= 1.1; surface triangles are kept as they are
  double max_volume = 0;  ///< largest tetrahedron [m^3], 0: no limit; beside coarse surface triangles some stay larger
  double seconds = 300;   ///< time limit, > 0
  std::function<void()> poll;  ///< called some 50 times a second while waiting; what it throws stops the work
};

/// Whether this program was built with TetGen.
bool has_tetgen();

/// Fills a closed surface. Vertices 0 .. n-1 of the result are the surface's vertices, same order, same bits; further
/// ones lie inside. The boundary of the result is the surface's triangles. Throws UserError(kInput, name, ...) when the
/// surface is open, non-manifold, crosses itself or is inside out (what and where), when TetGen crashes, gives nothing,
/// takes too long or is killed, and when the program was built without it; never returns a body that is empty, turned
/// over or of another volume than the surface encloses (relative 1e-6).
sim::TetMesh tetrahedralize(const sim::TriangleMesh& surface, const std::string& name,
                            const TetrahedralizeOptions& options = {});

struct CachedTets {
  sim::TetMesh mesh;
  bool from_cache = false;
};

/// The same with a cache: the key is the content (vertices, triangles, options), a damaged file in the cache is made
/// anew. An empty `cache_folder`: no cache. A cache that cannot be written is an UserError(kOutput).
CachedTets tetrahedralize_cached(const sim::TriangleMesh& surface, const std::string& name,
                                 const TetrahedralizeOptions& options, const std::filesystem::path& cache_folder);

/// How often this process has started TetGen; lets tests and the stats say that a scene never did.
int tetgen_runs();

}  // namespace softreel::assets
