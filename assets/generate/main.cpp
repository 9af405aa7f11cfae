// Writes the project's own meshes: softreel_make_assets FOLDER
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "assets/export_pc2.h"
#include "assets/generate/disc.h"
#include "assets/generate/models.h"
#include "assets/generate/polygonize.h"
#include "assets/generate/studio.h"
#include "assets/surface_diagnosis.h"

namespace {

using namespace softreel;

bool make(const generate::Model& model, const std::filesystem::path& folder) {
  const double cell = 0.55 * model.edge_length(model.high);
  sim::TriangleMesh mesh = generate::polygonize(model.surface, model.low, model.high, cell);
  generate::remesh(mesh, model.surface, model.edge_length, 25);
  const std::vector<int> paint_of = generate::apply_paints(mesh, model.surface, model.paints);
  const std::string wrong = assets::describe(assets::diagnose_surface(mesh));
  fmt::print("{}: {} vertices, {} triangles {}\n", model.name, mesh.vertices.size(), mesh.triangles.size(), wrong);
  if (!wrong.empty()) return false;
  generate::write_painted_obj(folder / (model.name + ".obj"), mesh, paint_of, model.paints);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: softreel_make_assets FOLDER\n");
    return 2;
  }
  try {
    bool good = true;
    for (const generate::Model& model : {generate::dragon(), generate::jelly_cube(), generate::jelly_star(),
                                         generate::jelly_ring(), generate::jelly_bear()}) {
      good = make(model, argv[1]) && good;
    }
    const sim::TriangleMesh drumhead = generate::disc(0.5, 32);
    assets::write_obj(std::filesystem::path(argv[1]) / "disc.obj", drumhead.vertices, drumhead.triangles);
    generate::write_studio(std::filesystem::path(argv[1]) / "studio.hdr");
    return good ? 0 : 6;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 5;
  }
}
