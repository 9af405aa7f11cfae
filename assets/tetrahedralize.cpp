#include "assets/tetrahedralize.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "assets/child_process.h"
#include "assets/error.h"
#include "assets/surface_diagnosis.h"
#include "assets/tet_check.h"
#include "assets/tetgen_request.h"

namespace softreel::assets {
namespace {

// TetGen needs some 1 kB per tetrahedron; 12 GB hold more than any simulation here can.
constexpr std::size_t kMemory = std::size_t{12} << 30;
constexpr double kMostTets = 5e6;

std::atomic<int> runs{0};

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw UserError(ErrorKind::kInput, name, why);
}

void check_options(const std::string& name, const TetrahedralizeOptions& options, double volume) {
  if (!(options.quality >= 1.1) || !(options.max_volume >= 0) || !(options.seconds > 0)) {
    throw std::logic_error("tetrahedralize: quality >= 1.1, max_volume >= 0 and seconds > 0 are needed");
  }
  if (options.max_volume > 0 && volume / options.max_volume > kMostTets) {
    refuse(name, fmt::format("tetrahedra of at most {:g} m^3 in a volume of {:g} m^3 would be more than {:g}; "
                             "raise max_volume",
                             options.max_volume, volume, kMostTets));
  }
}

/// The power of two that brings the longest side into [1, 2): TetGen gets numbers of its usual size, and no bit is
/// lost.
double exact_scale(const sim::TriangleMesh& surface) {
  sim::Vec3 low = surface.vertices.front(), high = low;
  for (const sim::Vec3& p : surface.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return std::ldexp(1.0, -std::ilogb((high - low).maxCoeff()));
}

TetgenReply run_tetgen(const sim::TriangleMesh& surface, const std::string& name,
                       const TetrahedralizeOptions& options) {
  const double scale = exact_scale(surface);
  TetgenRequest request;
  request.vertices = surface.vertices;
  for (sim::Vec3& p : request.vertices) p *= scale;
  request.triangles = surface.triangles;
  request.quality = options.quality;
  request.max_volume = options.max_volume * scale * scale * scale;
  ++runs;
  const ChildResult result = run_worker("tetgen", write_request(request), {options.seconds, kMemory, options.poll});
  if (result.end != ChildResult::End::kDone) {
    const bool slow = result.end == ChildResult::End::kTimeout;
    refuse(name, fmt::format("the surface is closed and does not cross itself, but TetGen {} on its {} faces; {}",
                             result.how_it_ended(options.seconds), surface.triangles.size(),
                             slow ? "raise max_volume or simplify the mesh" : "simplify or remesh it"));
  }
  TetgenReply reply;
  try {
    reply = read_reply(result.output);
  } catch (const BrokenBlob&) {
    return {};  // no tetrahedra: refused as such
  }
  for (sim::Vec3& p : reply.vertices) p /= scale;
  return reply;
}

}  // namespace

bool has_tetgen() { return has_tetgen_library(); }

int tetgen_runs() { return runs; }

sim::TetMesh tetrahedralize(const sim::TriangleMesh& surface, const std::string& name,
                            const TetrahedralizeOptions& options) {
  if (!has_tetgen()) {
    refuse(name,
           "is a surface, and this program was built without TetGen (-DSOFTREEL_TETGEN=OFF), which would fill it "
           "with tetrahedra; give a tetrahedral file (.msh, .mesh, .node/.ele)");
  }
  const SurfaceDiagnosis diagnosis = diagnose_surface(surface);
  if (!diagnosis.bounds_solid()) refuse(name, describe(diagnosis));
  check_options(name, options, diagnosis.volume);
  sim::TetMesh mesh;
  const std::string wrong = accept_tets(surface, run_tetgen(surface, name, options), diagnosis.volume, mesh);
  if (!wrong.empty()) {
    refuse(name, fmt::format("the surface is closed and does not cross itself, but {}; simplify or remesh it", wrong));
  }
  return mesh;
}

}  // namespace softreel::assets
