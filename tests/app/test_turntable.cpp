#include "assets/export_pc2.h"
#include "render/image_io.h"
#include "tests/app/clip.h"

using namespace softreel;

namespace {

/// A spike sticks out of it to one side: every view of it is another.
std::filesystem::path lopsided(const test::TempFolder& folder) {
  sim::TriangleMesh mesh = test::cube();
  mesh.vertices[7] = sim::Vec3(2, 0.4, 0.3);
  assets::write_obj(folder / "spike.obj", mesh.vertices, mesh.triangles);
  return folder / "spike.obj";
}

test::RunResult turntable(const std::filesystem::path& mesh, const std::filesystem::path& out, const std::string& count,
                          std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"turntable", mesh.string(), "-o", out.string(), "--count", count, "--size", "64", "48",
                             "--samples", "1"});
  test::RunResult result = test::run(more);
  INFO(result.err);
  CHECK(result.code == 0);
  return result;
}

}  // namespace

TEST_CASE("A turntable has even steps and no doubled last frame") {
  test::TempFolder folder;
  const auto mesh = lopsided(folder);
  turntable(mesh, folder / "four", "4");
  turntable(mesh, folder / "eight", "8");
  const auto four = test::pictures_in(folder / "four"), eight = test::pictures_in(folder / "eight");
  CHECK(four.size() == 4);
  CHECK(eight.size() == 8);
  // Picture k of four is picture 2 k of eight: the same angle. Angles come from another division: compare as pictures.
  for (int k = 0; k < 4; ++k) {
    const std::string in_four = "frame_000" + std::to_string(k + 1) + ".png",
                      in_eight = "frame_000" + std::to_string(2 * k + 1) + ".png";
    CHECK(test::run({"compare", (folder / "four" / in_four).string(), (folder / "eight" / in_eight).string()}).code ==
          0);
  }
  for (const auto& [name, bytes] : eight)
    for (const auto& [other, other_bytes] : eight)
      if (name < other)
        CHECK(render::load_image(folder / "eight" / name).rgba != render::load_image(folder / "eight" / other).rgba);
  test::check_only_whole_files(folder.path());
}

TEST_CASE("A turntable takes tetrahedral files, one picture, the axis that is up and a colour") {
  test::TempFolder folder;
  folder.write("t.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
  folder.write("t.ele", "1 4 0\n0 0 1 2 3\n");
  turntable(folder / "t.node", folder / "tet", "1");
  CHECK(test::pictures_in(folder / "tet").size() == 1);
  const auto mesh = lopsided(folder);
  turntable(mesh, folder / "y", "1");
  turntable(mesh, folder / "z", "1", {"--up", "z"});
  turntable(mesh, folder / "red", "1", {"--color", "red"});
  CHECK(test::pictures_in(folder / "y") != test::pictures_in(folder / "z"));
  CHECK(test::pictures_in(folder / "y") != test::pictures_in(folder / "red"));
}
