#include <assimp/scene.h>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>

#include "assets/surface_diagnosis.h"
#include "assets/surface_import.h"
#include "tests/assets/support.h"

using namespace softreel;
using assets::ErrorKind;
using assets::import_surface;
using test::contains;

namespace {

const char* const kCubeObj = R"(mtllib cube.mtl
v -1 -1 -1
v 1 -1 -1
v -1 1 -1
v 1 1 -1
v -1 -1 1
v 1 -1 1
v -1 1 1
v 1 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl red
f 1/1 3/2 4/3 2/4
f 5/1 6/2 8/3 7/4
f 1/1 2/2 6/3 5/4
usemtl blue
f 3/1 7/2 8/3 4/4
f 1/1 5/2 7/3 3/4
f 2/1 4/2 8/3 6/4
)";

const char* const kCubeMtl =
    "newmtl red\nKd 0.8 0.1 0.05\nKs 0.04 0.04 0.04\nNs 30\nmap_Kd C:\\pictures\\skin.png\n\nnewmtl blue\nKd 0 0 "
    "1\nmap_Kd none.png\n";

void check_consistent(const assets::ImportedSurface& s) {
  REQUIRE(s.triangles.size() == s.welded.triangles.size());
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(s.position_of.at(static_cast<std::size_t>(s.triangles[i][k])) == s.welded.triangles[i][k]);
    }
  }
  CHECK((s.uv.empty() || s.uv.size() == s.position_of.size()));
  CHECK((s.normals.empty() || s.normals.size() == s.position_of.size()));
  int next = 0;
  for (const auto& part : s.parts) {
    CHECK(part.first_triangle == next);
    next += part.triangle_count;
  }
  CHECK(next == static_cast<int>(s.triangles.size()));
}

}  // namespace

TEST_CASE("An OBJ keeps seams for the picture, welds for the physics, and brings colours and textures") {
  test::TempFolder folder;
  folder.write("cube.mtl", kCubeMtl);
  folder.write("skin.png", "a picture");
  const auto s = import_surface(folder.write("cube.obj", kCubeObj));
  check_consistent(s);
  CHECK(s.welded.vertices.size() == 8);
  CHECK(s.position_of.size() == 20);  // 24 corners; 1/1 and 8/3 are there three times
  CHECK(s.uv.size() == 20);
  CHECK(s.triangles.size() == 12);
  CHECK(assets::diagnose_surface(s.welded).bounds_solid());
  REQUIRE(s.parts.size() == 2);
  CHECK(s.parts[0].name == "red");
  CHECK(s.parts[0].triangle_count == 6);
  REQUIRE(s.parts[0].base_color);
  CHECK((*s.parts[0].base_color)[0] == doctest::Approx(0.8));
  CHECK(*s.parts[0].roughness == doctest::Approx(0.5));  // (2 / 32)^(1/4)
  CHECK(s.parts[0].texture.file.filename() == "skin.png");
  CHECK(s.parts[0].texture.file.is_absolute());
  CHECK(s.missing_textures == std::vector<std::string>{"none.png"});
}

TEST_CASE("An OBJ whose MTL is missing is a plain surface") {
  test::TempFolder folder;
  const auto s = import_surface(folder.write("cube.obj", kCubeObj));
  check_consistent(s);
  CHECK(s.triangles.size() == 12);
  for (const auto& part : s.parts) CHECK_FALSE(part.base_color);
}

TEST_CASE("A concave polygon is cut without leaving its outline") {
  test::TempFolder folder;
  // An arrow head: its area is 2, a fan from its first corner would have 4.
  const auto s = import_surface(folder.write("a.obj", "v 2 2 0\nv 0 1 0\nv -2 2 0\nv 0 -1 0\nf 1 2 3 4\n"));
  REQUIRE(s.triangles.size() == 2);
  CHECK(assets::diagnose_surface(s.welded).area == doctest::Approx(4));
  const auto u = import_surface(folder.write(
      "u.obj", "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8\n"));
  CHECK(u.triangles.size() == 6);
  CHECK(assets::diagnose_surface(u.welded).area == doctest::Approx(7));
}

TEST_CASE("Near vertices weld, apart ones do not, what has no area is dropped and counted") {
  test::TempFolder folder;
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 1.00000006 0 0\nv 1.00001 1 0\nv 0.5 0.5 0\nv 9 9 9\n";
  const auto s =
      import_surface(folder.write("a.obj", text + "f 1 2 3\nf 5 4 3\nf 4 6 3\nf 2 5 3\nf 1 7 4\nl 1 2\np 3\n"));
  check_consistent(s);
  CHECK(s.welded.vertices.size() == 5);
  CHECK(s.dropped_degenerate == 2);  // 2 5 3 after welding, 1 7 4 on a line
  CHECK(s.dropped_other >= 1);
  CHECK(s.triangles.size() == 3);
}

TEST_CASE("Unit, up and size act on the import") {
  test::TempFolder folder;
  const auto file =
      folder.write("t.obj", "v 0 0 0\nv 100 0 0\nv 0 200 0\nv 0 0 400\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  assets::MeshOptions options;
  options.unit = 0.01;
  options.up = 'z';
  auto s = import_surface(file, options);
  Eigen::AlignedBox3d box;
  for (const auto& p : s.welded.vertices) box.extend(p);
  CHECK(box.sizes().isApprox(sim::Vec3(1, 4, 2)));
  CHECK(box.min().y() == doctest::Approx(0));
  CHECK(assets::diagnose_surface(s.welded).volume == doctest::Approx(8.0 / 6));  // still faces outwards
  options.size = 0.5;
  s = import_surface(file, options);
  CHECK(assets::diagnose_surface(s.welded).volume == doctest::Approx(8.0 / 6 / 512));
}

TEST_CASE("OFF and STL bring no colours, PLY and STL weld into one solid") {
  test::TempFolder folder;
  const auto tetra =
      folder.write("t.off", "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const auto s = import_surface(tetra);
  check_consistent(s);
  CHECK(s.welded.vertices.size() == 4);
  CHECK_FALSE(s.parts[0].base_color);
  const auto ply = import_surface(folder.write(
      "t.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 "
      "1 2 3\n"));
  CHECK(assets::diagnose_surface(ply.welded).volume == doctest::Approx(1.0 / 6));
  std::string stl = "solid t\n";
  for (const auto& t : s.welded.triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const int v : t) {
      const sim::Vec3& p = s.welded.vertices[static_cast<std::size_t>(v)];
      stl += "vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    }
    stl += "endloop\nendfacet\n";
  }
  const auto solid = import_surface(folder.write("t.STL", stl + "endsolid t\n"));
  CHECK(solid.welded.vertices.size() == 4);
  CHECK(solid.normals.empty());
  CHECK_FALSE(solid.parts[0].base_color);
  CHECK(assets::diagnose_surface(solid.welded).bounds_solid());
}

TEST_CASE("Every format that is offered reads the same solid, with colours where it has them") {
  test::TempFolder folder;
  folder.write("cube.mtl", "newmtl red\nKd 0.8 0.1 0.05\n\nnewmtl blue\nKd 0 0 1\n");
  const auto obj = folder.write("cube.obj", kCubeObj);
  const std::map<std::string, std::string> formats = {
      {"obj", "obj"},     {"ply", "plyb"}, {"stl", "stlb"}, {"gltf", "gltf2"}, {"glb", "glb2"}, {"fbx", "fbxa"},
      {"dae", "collada"}, {"3ds", "3ds"},  {"3mf", "3mf"},  {"x", "x"},        {"x3d", "x3d"}};
  for (const auto& [extension, id] : formats) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(obj.string(), 0x8 /* triangulate */);
    REQUIRE(scene);
    const auto file = folder / ("out." + extension);
    Assimp::Exporter exporter;
    REQUIRE_MESSAGE(exporter.Export(scene, id, file.string()) == AI_SUCCESS, extension);
    try {
      const auto s = import_surface(file);
      check_consistent(s);
      const auto d = assets::diagnose_surface(s.welded);
      CHECK_MESSAGE(s.welded.vertices.size() == 8, extension);
      CHECK_MESSAGE(d.bounds_solid(), extension << ": " << assets::describe(d));
      if (extension == "obj" || extension == "gltf" || extension == "glb" || extension == "fbx" || extension == "dae") {
        REQUIRE_MESSAGE(s.parts.size() == 2, extension);
        const bool red_first = s.parts[0].name == "red";
        REQUIRE_MESSAGE(s.parts[red_first ? 0 : 1].base_color, extension);
        CHECK_MESSAGE((*s.parts[red_first ? 0 : 1].base_color)[0] == doctest::Approx(0.8), extension);
      }
    } catch (const assets::UserError& error) {
      FAIL_CHECK(extension << ": " << std::string(error.what()));
    }
  }
}

TEST_CASE("Node transforms are applied, and a mirroring one keeps the outside outside") {
  test::TempFolder folder;
  // One triangle mesh (a tetrahedron), placed twice: shifted, and mirrored in x and scaled by 2.
  const std::string buffer =
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMAAAADAAIAAQACAAMA";
  const auto file = folder.write("two.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"children":[1,2],"translation":[0,10,0]},{"mesh":0},{"mesh":0,"translation":[5,0,0],"scale":[-2,2,2]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
                 {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
    "buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,)" +
                                                 buffer + R"("}]})");
  const auto s = import_surface(file);
  const auto d = assets::diagnose_surface(s.welded);
  CHECK(d.bounds_solid());
  CHECK(d.components == 2);
  CHECK(d.volume == doctest::Approx(1.0 / 6 + 8.0 / 6).epsilon(1e-6));
  Eigen::AlignedBox3d box;
  for (const auto& p : s.welded.vertices) box.extend(p);
  CHECK(box.min().isApprox(sim::Vec3(0, 10, 0)));
  CHECK(box.max().isApprox(sim::Vec3(5, 12, 2)));
}

TEST_CASE("Files that are no meshes are refused with what they are and what would do") {
  test::TempFolder folder;
  const auto message = [](const std::filesystem::path& file) {
    return test::user_error(ErrorKind::kInput, [&] { import_surface(file); });
  };
  CHECK(contains(message(folder / "none.obj"), "there is no such file"));
  CHECK(contains(message(folder.path()), "is a folder"));
  CHECK(contains(message(folder.write("a.txt", "x")), "these are: obj, ply, stl"));
  CHECK(contains(message(folder.write("a.obj", "")), "is empty"));
  CHECK(contains(message(folder.write("b.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")), "triangles"));
  CHECK(contains(message(folder.write("c.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")), "c.obj"));
  CHECK(contains(message("/dev/null"), "no regular file"));
  assets::ImportLimits limits;
  limits.triangles = 5;
  const auto cube = folder.write("cube.obj", kCubeObj);
  CHECK(contains(test::user_error(ErrorKind::kInput, [&] { import_surface(cube, {}, limits); }),
                 "more than 5 triangles"));
  limits = {};
  limits.file_bytes = 100;
  CHECK(contains(test::user_error(ErrorKind::kInput, [&] { import_surface(cube, {}, limits); }), "at most 100"));
  limits = {};
  limits.seconds = 1e-6;
  CHECK(contains(test::user_error(ErrorKind::kInput, [&] { import_surface(cube, {}, limits); }), "took longer"));
}
