// softreel tetrahedralize MESH -o OUT.msh
#include <fmt/format.h>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "assets/surface_import.h"
#include "assets/tet_file.h"
#include "assets/tet_quality.h"
#include "assets/tetrahedralize.h"

namespace softreel::app {

int run_tetrahedralize(const TetrahedralizeArguments& a) {
  use_threads(a.threads);
  assets::check_tet_output(a.output);
  check_output_file(a.output);
  const assets::MeshOptions mesh{a.unit, a.up[0], a.size};
  sim::TetMesh tets;
  if (assets::is_tet_file(a.mesh)) {
    tets = assets::read_tet_file(a.mesh, mesh).mesh;
  } else {
    assets::ImportLimits limits;
    limits.poll = stop_if_interrupted;
    const assets::ImportedSurface surface = assets::import_surface(a.mesh, mesh, limits);
    assets::TetrahedralizeOptions options;
    options.quality = a.quality;
    options.max_volume = a.max_volume;
    options.seconds = a.time_limit;
    options.poll = stop_if_interrupted;
    tets = assets::tetrahedralize(surface.welded, a.mesh, options);
  }
  assets::write_tet_file(a.output, tets);
  const assets::TetQuality q = assets::tet_quality(tets);
  fmt::print("{}\n", a.output);
  fmt::print("tetrahedra      {}\nvertices        {}\n", q.tets, q.vertices);
  fmt::print("volume          {:.6g} m^3 (one tetrahedron: {:.3g} to {:.3g})\n", q.volume, q.smallest_volume,
             q.largest_volume);
  fmt::print("radius ratio    worst {:.4f}, median {:.4f} (1: regular, 0: flat)\n", q.worst_radius_ratio,
             q.median_radius_ratio);
  fmt::print("dihedral angle  {:.2f} to {:.2f} degrees, median {:.2f}\n", q.min_dihedral, q.max_dihedral,
             q.median_dihedral);
  return kDone;
}

}  // namespace softreel::app
