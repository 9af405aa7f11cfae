// What other programs get: moving meshes and tetrahedra.
#include "assets/export_pc2.h"
#include "assets/surface_import.h"
#include "assets/tet_file.h"
#include "tests/app/clip.h"

using namespace softreel;
namespace fs = std::filesystem;

namespace {

fs::path exported(const test::TempFolder& folder, const std::string& format, const std::string& frames = "1-8",
                  const std::string& text = test::small_scene()) {
  const std::string scene = folder.write("scene.toml", text).string();
  const test::RunResult result =
      test::run({"simulate", scene, "-o", (folder / "out").string(), "--export", format, "--frames", frames});
  INFO(result.err);
  CHECK(result.code == 0);
  test::check_only_whole_files(folder / "out");
  return folder / "out/export";
}

}  // namespace

TEST_CASE("simulate --export ply writes a surface for each body and frame, and it moves") {
  test::TempFolder folder;
  const fs::path out = exported(folder, "ply", "1,8");
  CHECK(test::files_below(out).size() == 4);
  const auto first = assets::import_surface(out / "sheet_0001.ply"),
             last = assets::import_surface(out / "sheet_0008.ply");
  CHECK(first.welded.vertices.size() == 81);
  CHECK(first.welded.triangles.size() == 128);
  CHECK(first.welded.vertices[40].y() == doctest::Approx(0.8));
  CHECK(last.welded.vertices[40].y() < 0.75);
  CHECK(assets::import_surface(out / "block_0008.ply").welded.triangles.size() == 48);
}

TEST_CASE("simulate --export vtu writes tetrahedra and triangles and a time series") {
  test::TempFolder folder;
  const fs::path out = exported(folder, "vtu");
  CHECK(test::files_below(out).size() == 17);
  const std::string series = test::slurp(out / "clip.pvd");
  for (const char* name : {"block_0001.vtu", "sheet_0008.vtu"}) {
    CHECK(test::contains(series, name));
    CHECK(test::contains(test::slurp(out / name), "UnstructuredGrid"));
  }
  CHECK(test::contains(test::slurp(out / "block_0001.vtu"), "NumberOfPoints=\"27\""));
}

TEST_CASE("simulate --export pc2 writes point caches with the vertices of the meshes beside them") {
  test::TempFolder folder;
  const fs::path out = exported(folder, "pc2");
  CHECK(test::files_below(out).size() == 4);
  for (const char* name : {"sheet", "block"}) {
    const auto mesh = assets::import_surface(out / (std::string(name) + ".obj"));
    const std::string cache = test::slurp(out / (std::string(name) + ".pc2"));
    // POINTCACHE2\0, version, points, start, rate, samples; then floats
    // (http://mattebb.com/projects/bpython/pointcache)
    REQUIRE(cache.size() > 32);
    CHECK(cache.substr(0, 12) == std::string("POINTCACHE2\0", 12));
    std::int32_t points = 0, samples = 0;
    std::memcpy(&points, cache.data() + 16, 4);
    std::memcpy(&samples, cache.data() + 28, 4);
    CHECK(samples == 8);
    CHECK(points >= static_cast<int>(mesh.welded.vertices.size()));
    CHECK(cache.size() == 32 + 12u * static_cast<std::size_t>(points) * 8u);
  }
}

TEST_CASE("Names of bodies that are no names of files do not leave the folder") {
  test::TempFolder folder;
  std::string text;
  for (const char* name : {"/tmp/softreel-absolute", "a/b", "a:b", "a_b", "-dash", "büst"})
    text +=
        "[[cloth]]\nname = \"" + std::string(name) + "\"\ngrid = { cells = [1, 1] }\ncontact = { others = false }\n";
  const fs::path out = exported(folder, "ply", "1", "[time]\nduration = 0.05\n" + text);
  CHECK(test::files_below(out).size() == 6);
  for (const auto& [name, bytes] : test::files_below(folder.path()))
    if (name.ends_with(".ply")) CHECK(name.starts_with("out/export/"));
  CHECK_FALSE(fs::exists("/tmp/softreel-absolute_0001.ply"));
}

TEST_CASE("tetrahedralize writes files that are read again, and prints what is in them") {
  test::TempFolder folder;
  const auto ball = test::sphere(2);
  assets::write_obj(folder / "ball.obj", ball.vertices, ball.triangles);
  for (const char* name : {"ball.msh", "ball.mesh", "ball.node", "ball.vtu"}) {
    INFO(name);
    const test::RunResult result = test::run({"tetrahedralize", (folder / "ball.obj").string(), "-o",
                                              (folder / name).string(), "--max-volume", "0.05", "--size", "4"});
    INFO(result.err);
    REQUIRE(result.code == 0);
    for (const char* word : {"tetrahedra", "vertices", "volume", "radius ratio", "dihedral"})
      CHECK(test::contains(result.out, word));
    if (!assets::is_tet_file(folder / name)) continue;
    const sim::TetMesh mesh = assets::read_tet_file(folder / name).mesh;
    CHECK(test::contains(result.out, std::to_string(mesh.tets.size())));
    CHECK(test::volume(mesh) == doctest::Approx(8 * 4.0 / 3 * M_PI).epsilon(0.1));
  }
  // From one format into another: the same tetrahedra.
  REQUIRE(test::run({"tetrahedralize", (folder / "ball.msh").string(), "-o", (folder / "again.mesh").string()}).code ==
          0);
  CHECK(assets::read_tet_file(folder / "again.mesh").mesh.tets == assets::read_tet_file(folder / "ball.msh").mesh.tets);
}
