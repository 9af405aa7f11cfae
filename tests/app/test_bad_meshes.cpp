// Meshes that cannot be used, through every command that takes one.
#include <assimp/scene.h>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>

#include <random>

#include "assets/export_pc2.h"
#include "assets/tet_file.h"
#include "tests/app/bad_input.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

std::filesystem::path write_obj(const test::TempFolder& folder, const std::string& name,
                                const sim::TriangleMesh& mesh) {
  assets::write_obj(folder / name, mesh.vertices, mesh.triangles);
  return folder / name;
}

/// `mesh` as the only body of a scene.
std::string scene_around(const test::TempFolder& folder, const std::filesystem::path& mesh) {
  return folder
      .write("scene.toml", "[[soft]]\nmesh = \"" + mesh.filename().string() +
                               "\"\n[time]\nduration = 0.06\nsubsteps = 1\n[render]\nsize = [32, 24]\nsamples = 1\n")
      .string();
}

}  // namespace

TEST_CASE("A surface that bounds no volume is refused with what is wrong with it") {
  test::TempFolder folder;
  sim::TriangleMesh open = test::cube();
  open.triangles.pop_back();
  sim::TriangleMesh three_at_an_edge = test::cube();
  three_at_an_edge.vertices.push_back(sim::Vec3(2, 2, 2));
  three_at_an_edge.triangles.push_back({three_at_an_edge.triangles[0][0], three_at_an_edge.triangles[0][1], 8});
  const std::vector<std::tuple<std::string, sim::TriangleMesh, std::string>> surfaces = {
      {"open", open, "open"},
      {"crossing", test::together(test::cube(), test::cube(0.5, sim::Vec3(0.5, 0.3, 0.2))), "cross"},
      {"non-manifold", three_at_an_edge, "edge"},
      {"inside-out", test::turned_over(test::cube()), "inside"},
  };
  for (const auto& [name, mesh, says] : surfaces) {
    const auto file = write_obj(folder, name + ".obj", mesh);
    const std::string out = (folder / (name + ".msh")).string();
    test::check_refused({name + " surface", {"tetrahedralize", file.string(), "-o", out}, 3, {name + ".obj", says}});
    CHECK_FALSE(std::filesystem::exists(out));
    test::check_refused({name + " surface in a scene",
                         {"render", scene_around(folder, file), "-o", (folder / "out").string()},
                         3,
                         {name + ".obj", says}});
  }
  CHECK(test::pictures_in(folder / "out").empty());
  test::check_only_whole_files(folder.path());
}

TEST_CASE("A real mesh that crosses itself is refused") {
  const std::filesystem::path cow = std::filesystem::path(SOFTREEL_SHARED_MESHES) / "cow.off";
  if (!std::filesystem::exists(cow)) {
    MESSAGE("skipped: there is no " << cow.string());
    return;
  }
  test::TempFolder folder;
  test::check_refused(
      {"cow", {"tetrahedralize", cow.string(), "-o", (folder / "cow.msh").string()}, 3, {"cow.off", "cross"}});
  CHECK(folder.files() == 0);
}

TEST_CASE("What is no mesh is refused") {
  test::TempFolder folder;
  const auto expect = [&](const std::string& what, const std::string& file, const std::string& says) {
    test::check_refused({what, {"turntable", file, "-o", (folder / "out").string()}, 3, {says}});
    test::check_refused({what, {"tetrahedralize", file, "-o", (folder / "out.msh").string()}, 3, {says}});
  };
  expect("missing file", (folder / "none.obj").string(), "none.obj");
  expect("missing tetrahedra", (folder / "none.msh").string(), "none.msh");
  expect("folder", folder.path().string(), "folder");
  expect("empty file", folder.write("empty.obj", "").string(), "empty");
  expect("points without faces", folder.write("points.obj", "v 0 0 0\nv 1 0 0\n").string(), "points.obj");
  expect("NaN", folder.write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string(), "nan.obj");
  expect("faces without area", folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").string(), "flat.obj");
  expect("another kind of file", folder.write("mesh.txt", "hello").string(), "txt");
  expect("half a pair", folder.write("half.node", "0 3 0 0\n").string(), "half.ele");
  CHECK(test::pictures_in(folder / "out").empty());
}

TEST_CASE("Truncated and random files of every mesh format are refused or drawn, never a crash") {
  test::TempFolder folder;
  std::mt19937 random(3);
  const auto ball = write_obj(folder, "ball.obj", test::sphere(1));
  std::vector<std::string> names = {"ball.obj"};
  for (const auto& [name, id] : std::vector<std::pair<std::string, std::string>>{{"b.ply", "plyb"},
                                                                                 {"a.ply", "ply"},
                                                                                 {"b.stl", "stlb"},
                                                                                 {"a.gltf", "gltf2"},
                                                                                 {"a.glb", "glb2"},
                                                                                 {"a.fbx", "fbxa"},
                                                                                 {"a.dae", "collada"},
                                                                                 {"a.3ds", "3ds"},
                                                                                 {"a.x", "x"}}) {
    Assimp::Importer importer;
    REQUIRE(Assimp::Exporter().Export(importer.ReadFile(ball.string(), 0), id, (folder / name).string()) == AI_SUCCESS);
    names.push_back(name);
  }
  for (const char* name : {"t.msh", "t.mesh", "t.node"}) {
    assets::write_tet_file(folder / name, test::five_tets());
    names.push_back(name);
  }
  names.push_back("t.ele");
  const std::string out = (folder / "out").string();
  for (const std::string& name : names) {
    const std::string good = test::slurp(folder / name);
    std::string noise(500, '\0');
    for (char& c : noise) c = static_cast<char>(random());
    for (const auto& [kind, bytes] : {std::pair("half", good.substr(0, good.size() / 2)), std::pair("random", noise),
                                      std::pair("noisy end", good.substr(0, 2 * good.size() / 3) + noise)}) {
      INFO(name << ", " << kind);
      folder.write(name, bytes);
      const std::vector<std::vector<std::string>> commands = {
          {"turntable", (folder / name).string(), "-o", out, "--count", "1", "--size", "16", "16", "--samples", "1"},
          {"tetrahedralize", (folder / name).string(), "-o", (folder / "o.msh").string(), "--time-limit", "20"}};
      const test::RunResult result = test::run(commands[random() % 2]);
      INFO(result.err);
      CHECK(result.in_time);
      CHECK(result.signal == 0);
      CHECK((result.code == 0 || result.code == 3));
      if (result.code == 3) CHECK(test::contains(result.err, name.substr(0, 2)));
      if (std::string(kind) == "random") CHECK(result.code == 3);
    }
    folder.write(name, good);
  }
  test::check_only_whole_files(folder.path());
}
