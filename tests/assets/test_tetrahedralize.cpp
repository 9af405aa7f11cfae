#include <csignal>
#include <thread>

#include "assets/child_process.h"
#include "assets/surface_diagnosis.h"
#include "assets/surface_import.h"
#include "assets/tet_quality.h"
#include "assets/tetrahedralize.h"
#include "tests/assets/support.h"

using namespace softreel;
using assets::ErrorKind;
using assets::tetrahedralize;
using test::contains;

namespace {

/// What tetrahedralize promises, checked from outside.
void check_fills(const sim::TriangleMesh& surface, const sim::TetMesh& mesh) {
  REQUIRE(mesh.vertices.size() >= surface.vertices.size());
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) REQUIRE(mesh.vertices[i] == surface.vertices[i]);
  double smallest = 1e300;
  for (const sim::Tet& t : mesh.tets) {
    const auto p = [&](std::size_t k) -> const sim::Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    smallest = std::min(smallest, sim::tet_volume(p(0), p(1), p(2), p(3)));
  }
  CHECK(smallest > 0);
  const double enclosed = assets::diagnose_surface(surface).volume;
  CHECK(test::volume(mesh) == doctest::Approx(enclosed).epsilon(1e-9));
  CHECK(sim::boundary_triangles(mesh).size() == surface.triangles.size());
}

}  // namespace

TEST_CASE("A cube and a sphere are filled and keep their vertices" * doctest::skip(!assets::has_tetgen())) {
  check_fills(test::cube(), tetrahedralize(test::cube(), "cube"));
  const auto ball = test::sphere(3);
  const auto mesh = tetrahedralize(ball, "ball");
  check_fills(ball, mesh);
  CHECK(assets::tet_quality(mesh).median_radius_ratio > 0.6);
}

TEST_CASE("The largest volume is aimed at, the same at any scale" * doctest::skip(!assets::has_tetgen())) {
  std::size_t tets = 0;
  for (const double scale : {0x1p-13, 1.0, 0x1p11}) {
    auto ball = test::sphere(3);
    for (sim::Vec3& p : ball.vertices) p *= scale;
    assets::TetrahedralizeOptions options;
    options.max_volume = 4e-4 * scale * scale * scale;
    const auto mesh = tetrahedralize(ball, "ball", options);
    check_fills(ball, mesh);
    // The surface's triangles stay as they are, so tets at them may be larger; their mean may not.
    CHECK(test::volume(mesh) / static_cast<double>(mesh.tets.size()) < options.max_volume);
    CHECK((tets == 0 || tets == mesh.tets.size()));
    tets = mesh.tets.size();
  }
}

TEST_CASE("A cavity stays empty" * doctest::skip(!assets::has_tetgen())) {
  const auto shell = test::together(test::cube(), test::turned_over(test::cube(0.3)));
  check_fills(shell, tetrahedralize(shell, "shell"));
}

TEST_CASE("Real meshes are filled, the cow is refused with what is wrong and where" *
          doctest::skip(!assets::has_tetgen())) {
  const std::filesystem::path folder = SOFTREEL_SHARED_MESHES;
  if (!std::filesystem::exists(folder / "cow.off")) {
    MESSAGE("no real meshes here: left out");
    return;
  }
  for (const char* name : {"spot.obj", "bunny.off", "3holes.off"}) {
    const auto surface = assets::import_surface(folder / name).welded;
    check_fills(surface, tetrahedralize(surface, name));
  }
  const auto cow = assets::import_surface(folder / "cow.off").welded;
  const int runs = assets::tetgen_runs();
  const std::string text = test::user_error(ErrorKind::kInput, [&] { tetrahedralize(cow, "cow.off"); });
  CHECK_MESSAGE(contains(text, "crosses itself in"), text);
  CHECK(contains(text, "near ("));
  CHECK(assets::tetgen_runs() == runs);  // found before TetGen could crash on it
}

TEST_CASE("Surfaces that bound no solid are refused by what is wrong" * doctest::skip(!assets::has_tetgen())) {
  auto open = test::cube();
  open.triangles.pop_back();
  const auto message = [](const sim::TriangleMesh& mesh) {
    return test::user_error(ErrorKind::kInput, [&] { tetrahedralize(mesh, "m.obj"); });
  };
  CHECK(contains(message(open), "m.obj: the surface bounds no solid: it is open, with 3 open edges around 1 hole"));
  CHECK(contains(message(test::turned_over(test::cube())), "inside out"));
  CHECK(contains(message(test::together(test::cube(), test::cube(0.5, {0.7, 0.2, 0.1}))), "crosses itself"));
  CHECK(contains(message({}), "no faces"));
  assets::TetrahedralizeOptions options;
  options.max_volume = 1e-12;
  const std::string text = test::user_error(ErrorKind::kInput, [&] { tetrahedralize(test::cube(), "c", options); });
  CHECK_MESSAGE(contains(text, "raise max_volume"), text);
}

TEST_CASE("A killed worker, a time limit and an interruption end the work clearly" *
          doctest::skip(!assets::has_tetgen())) {
  assets::TetrahedralizeOptions options;
  options.poll = [] {
    if (const int pid = assets::running_worker()) ::kill(pid, SIGKILL);
  };
  std::string text = test::user_error(ErrorKind::kInput, [&] { tetrahedralize(test::sphere(4), "ball", options); });
  CHECK_MESSAGE(contains(text, "was killed"), text);
  options.poll = nullptr;
  options.seconds = 1e-6;
  text = test::user_error(ErrorKind::kInput, [&] { tetrahedralize(test::sphere(4), "ball", options); });
  CHECK_MESSAGE(contains(text, "took longer than 1e-06 s"), text);
  options.seconds = 60;
  struct Stop {};
  options.poll = [] { throw Stop(); };
  CHECK_THROWS_AS(tetrahedralize(test::sphere(4), "ball", options), Stop);
  CHECK(assets::running_worker() == 0);
}

TEST_CASE("A worker that hangs is stopped within its time") {
  const auto start = std::chrono::steady_clock::now();
  const auto result = assets::run_worker("sleep", "", {0.2, 0, {}});
  CHECK(result.end == assets::ChildResult::End::kTimeout);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
  CHECK(assets::run_worker("no such task", "", {}).end == assets::ChildResult::End::kFailed);
}

TEST_CASE("The cache answers the second time and is not believed when damaged" * doctest::skip(!assets::has_tetgen())) {
  test::TempFolder folder;
  const auto ball = test::sphere(2);
  assets::TetrahedralizeOptions options;
  const auto run = [&] { return assets::tetrahedralize_cached(ball, "ball", options, folder / "cache/deep"); };
  const int before = assets::tetgen_runs();
  const auto first = run();
  CHECK_FALSE(first.from_cache);
  const auto second = run();
  CHECK(second.from_cache);
  CHECK(assets::tetgen_runs() == before + 1);
  CHECK(second.mesh.vertices == first.mesh.vertices);
  CHECK(second.mesh.tets == first.mesh.tets);
  options.quality = 1.8;
  CHECK_FALSE(run().from_cache);
  options.quality = 1.4;
  options.max_volume = 0.01;
  CHECK_FALSE(run().from_cache);
  options.max_volume = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache/deep")) {
    std::string bytes = test::slurp(entry.path());
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(entry.path(), std::ios::binary) << bytes;
  }
  const auto repaired = run();
  CHECK_FALSE(repaired.from_cache);
  CHECK(repaired.mesh.tets == first.mesh.tets);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache/deep")) {
    std::filesystem::resize_file(entry.path(), 100);
  }
  CHECK_FALSE(run().from_cache);
  CHECK(run().from_cache);
}

TEST_CASE("A program without TetGen says so" * doctest::skip(assets::has_tetgen())) {
  const std::string text = test::user_error(ErrorKind::kInput, [] { tetrahedralize(test::cube(), "cube.obj"); });
  CHECK(contains(text, "built without TetGen"));
}

TEST_CASE("The shipped meshes bound solids that become well-shaped tetrahedra" * doctest::skip(!assets::has_tetgen())) {
  const std::filesystem::path folder = std::filesystem::path(SOFTREEL_SOURCE_DIR) / "assets/meshes";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj" || entry.path().stem() == "disc") continue;  // the disc is a sheet
    ++count;
    CHECK(entry.file_size() < 500000);
    const auto surface = assets::import_surface(entry.path());
    for (const auto& part : surface.parts) CHECK(part.base_color.has_value());
    const auto q = assets::tet_quality(tetrahedralize(surface.welded, entry.path().string()));
    CHECK_MESSAGE(q.worst_radius_ratio > 0.05, entry.path().string());
    CHECK_MESSAGE(q.min_dihedral > 5, entry.path().string());
    CHECK_MESSAGE(q.tets < 20000, entry.path().string());
  }
  CHECK(count >= 5);
}
