#include <cstring>

#include "assets/export_pc2.h"
#include "assets/export_ply.h"
#include "assets/export_vtu.h"
#include "assets/surface_import.h"
#include "tests/assets/support.h"

using namespace softreel;
using assets::ErrorKind;

namespace {

/// Values behind the n-th DataArray of a .vtu with this name.
template <class T>
std::vector<T> appended(const std::string& vtu, const std::string& name) {
  const std::size_t array = vtu.find("Name=\"" + name + "\"");
  REQUIRE(array != std::string::npos);
  const std::size_t offset = std::stoul(vtu.substr(vtu.find("offset=\"", array) + 8, 20));
  const std::size_t block = vtu.find("<AppendedData encoding=\"raw\">") + 30;
  const std::size_t start = vtu.find('_', block) + 1 + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtu.data() + start, 8);
  REQUIRE(start + 8 + bytes <= vtu.size());
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), vtu.data() + start + 8, bytes);
  return values;
}

}  // namespace

TEST_CASE("A PLY holds the triangles, in order, and normals that look outwards") {
  test::TempFolder folder;
  const auto ball = test::sphere(2);
  assets::write_ply(folder / "ball.ply", ball.vertices, ball.triangles);
  const auto back = assets::import_surface(folder / "ball.ply");
  REQUIRE(back.welded.triangles == ball.triangles);
  REQUIRE(back.normals.size() == back.position_of.size());
  for (std::size_t i = 0; i < ball.vertices.size(); ++i) {
    CHECK((back.welded.vertices[i] - ball.vertices[i]).norm() < 1e-7);  // single precision
  }
  for (std::size_t i = 0; i < back.normals.size(); ++i) {
    const auto p = back.welded.vertices[static_cast<std::size_t>(back.position_of[i])];
    CHECK(back.normals[i].cast<double>().dot(p) > 0.99);
  }
}

TEST_CASE("A VTU holds points, velocities and cells exactly, and a PVD lists the frames") {
  test::TempFolder folder;
  const auto mesh = test::five_tets();
  const std::vector<sim::Triangle> triangles = {{0, 1, 2}};
  std::vector<sim::Vec3> velocities(mesh.vertices.size(), sim::Vec3(1.0 / 3, 0, -2));
  assets::write_vtu(folder / "a.vtu", {mesh.vertices, mesh.tets, triangles, velocities});
  const std::string vtu = test::slurp(folder / "a.vtu");
  CHECK(test::contains(vtu, "NumberOfPoints=\"8\" NumberOfCells=\"6\""));
  const auto points = appended<double>(vtu, "Points");
  REQUIRE(points.size() == 24);
  CHECK(std::memcmp(points.data(), mesh.vertices.data(), 24 * 8) == 0);
  CHECK(appended<double>(vtu, "velocity").at(3) == 1.0 / 3);
  const auto connectivity = appended<std::int32_t>(vtu, "connectivity");
  CHECK(std::vector(connectivity.begin(), connectivity.begin() + 4) ==
        std::vector<std::int32_t>(mesh.tets[0].begin(), mesh.tets[0].end()));
  CHECK(appended<std::int32_t>(vtu, "offsets") == std::vector<std::int32_t>{4, 8, 12, 16, 20, 23});
  CHECK(appended<std::uint8_t>(vtu, "types") == std::vector<std::uint8_t>{10, 10, 10, 10, 10, 5});
  assets::write_pvd(folder / "a.pvd", {{0.5, "frames/a & b.vtu", 1, "x<y"}});
  CHECK(test::contains(test::slurp(folder / "a.pvd"),
                       "timestep=\"0.5\" group=\"\" part=\"1\" name=\"x&lt;y\" file=\"frames/a &amp; b.vtu\""));
}

TEST_CASE("A PC2 has the header and the points that Blender reads, and appears when it is complete") {
  test::TempFolder folder;
  const std::vector<sim::Vec3> first = {{1, 2, 3}, {4, 5, 6}}, second = {{7, 8, 9}, {0.1, 0.2, 0.3}};
  assets::Pc2Writer writer(folder / "a.pc2", 2, 2);
  writer.add(first);
  CHECK_THROWS_AS(writer.finish(), std::logic_error);
  CHECK_FALSE(std::filesystem::exists(folder / "a.pc2"));
  writer.add(second);
  CHECK_THROWS_AS(writer.add(second), std::logic_error);
  writer.finish();
  const std::string bytes = test::slurp(folder / "a.pc2");
  REQUIRE(bytes.size() == 32 + 2 * 2 * 3 * 4);
  CHECK(std::memcmp(bytes.data(), "POINTCACHE2", 12) == 0);
  std::int32_t version, points, samples;
  float start, step, last;
  std::memcpy(&version, bytes.data() + 12, 4);
  std::memcpy(&points, bytes.data() + 16, 4);
  std::memcpy(&start, bytes.data() + 20, 4);
  std::memcpy(&step, bytes.data() + 24, 4);
  std::memcpy(&samples, bytes.data() + 28, 4);
  std::memcpy(&last, bytes.data() + bytes.size() - 4, 4);
  CHECK(version == 1);
  CHECK(points == 2);
  CHECK(samples == 2);
  CHECK(start == 1.0f);
  CHECK(step == 1.0f);
  CHECK(last == 0.3f);
}

TEST_CASE("The rest mesh keeps the order of its vertices") {
  test::TempFolder folder;
  assets::write_obj(folder / "rest.obj", test::cube().vertices, test::cube().triangles);
  const auto back = assets::import_surface(folder / "rest.obj");
  CHECK(back.welded.triangles.size() == 12);
  std::istringstream text(test::slurp(folder / "rest.obj"));
  for (const sim::Vec3& p : test::cube().vertices) {
    std::string v;
    double x, y, z;
    text >> v >> x >> y >> z;
    CHECK(v == "v");
    CHECK(sim::Vec3(x, y, z) == p);
  }
}

TEST_CASE("Exporters leave nothing where they cannot write") {
  test::TempFolder folder;
  folder.write("file", "x");
  const auto target = folder / "file/a";
  const auto mesh = test::cube();
  test::user_error(ErrorKind::kOutput, [&] { assets::write_ply(target, mesh.vertices, mesh.triangles); });
  test::user_error(ErrorKind::kOutput, [&] { assets::write_vtu(target, {mesh.vertices, {}, mesh.triangles, {}}); });
  test::user_error(ErrorKind::kOutput, [&] { assets::write_pvd(target, {}); });
  test::user_error(ErrorKind::kOutput, [&] { assets::Pc2Writer(target, 8, 1); });
  test::user_error(ErrorKind::kOutput, [&] { assets::write_obj(target, mesh.vertices, mesh.triangles); });
  CHECK(folder.files() == 1);
}
