#include "assets/tet_file.h"
#include "tests/assets/support.h"

using namespace softreel;
using assets::ErrorKind;
using assets::MshVersion;
using assets::read_tet_file;
using test::contains;

TEST_CASE("Every tetrahedral format gives back the same bits") {
  test::TempFolder folder;
  const auto mesh = test::five_tets();
  const auto check = [&](const std::string& name) {
    const auto read = read_tet_file(folder / name);
    CHECK_MESSAGE(read.mesh.vertices == mesh.vertices, name);
    CHECK_MESSAGE(read.mesh.tets == mesh.tets, name);
    CHECK(read.flipped == 0);
    CHECK(read.dropped_nodes == 0);
  };
  for (const bool binary : {false, true}) {
    for (const auto version : {MshVersion::k22, MshVersion::k41}) {
      assets::write_tet_file(folder / "t.msh", mesh, binary, version);
      check("t.msh");
    }
  }
  assets::write_tet_file(folder / "t.mesh", mesh);
  check("t.mesh");
  assets::write_tet_file(folder / "t.ele", mesh);
  check("t.node");
  check("t.ele");
  assets::write_tet_file(folder / "t.vtu", mesh);
  CHECK(contains(test::slurp(folder / "t.vtu"), "UnstructuredGrid"));
  CHECK(contains(test::user_error(ErrorKind::kUsage, [&] { assets::write_tet_file(folder / "t.obj", mesh); }), ".msh"));
}

TEST_CASE("A file of Gmsh with entities, triangles, gaps in the numbers and unused nodes is read") {
  test::TempFolder folder;
  const auto read = read_tet_file(folder.write("a.msh", R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "body"
$EndPhysicalNames
$Entities
0 0 1 1
1 0 0 0 1 1 1 0 0
1 0 0 0 1 1 1 1 1 0
$EndEntities
$Nodes
2 5 1 20
2 1 1 1
7
0 0 0 0.5 0.5
3 1 0 4
1
10
20
2
1 0 0
0 1 0
0 0 1
5 5 5
$EndNodes
$Elements
2 2 1 2
2 1 2 1
1 7 1 10
3 1 4 1
2 7 10 1 20
$EndElements
)"));
  CHECK(read.mesh.vertices.size() == 4);
  CHECK(read.dropped_nodes == 1);
  CHECK(read.dropped_elements == 1);
  CHECK(read.flipped == 1);
  CHECK(test::volume(read.mesh) == doctest::Approx(1.0 / 6));
}

TEST_CASE("Old Gmsh, Medit and TetGen files as their programs write them are read") {
  test::TempFolder folder;
  auto read =
      read_tet_file(folder.write("a.msh",
                                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 "
                                 "0 0 1e0\n$EndNodes\n$Elements\n3\n1 15 2 0 1 1\n2 2 2 0 1 1 2 3\n3 4 2 0 1 1 "
                                 "2 3 4\n$EndElements\n"));
  CHECK(read.mesh.tets.size() == 1);
  CHECK(read.dropped_elements == 2);
  read =
      read_tet_file(folder.write("a.mesh",
                                 "MeshVersionFormatted 1\n# comment\nDimension\n3\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 "
                                 "0 1\n0 0 1 1\nTriangles\n1\n1 2 3 0\nCorners 1\n1\nTetrahedra\n1\n1 2 3 4 0\nEnd\n"));
  CHECK(read.mesh.tets.size() == 1);
  CHECK(read.dropped_elements == 1);
  folder.write("b.1.node",
               "# Node count, 3 dim, 1 attribute, marker\n4 3 1 1\n 1 0 0 0 9.5 1\n 2 1 0 0 9.5 1\n 3 0 1 0 9.5 1\n 4 "
               "0 0 1 9.5 0\n# end\n");
  folder.write("b.1.ele", "1 4 1\n1 1 3 2 4 77\n# end\n");
  for (const char* name : {"b.1.node", "b.1.ele"}) {
    read = read_tet_file(folder / name);
    CHECK(read.mesh.tets.size() == 1);
    CHECK(read.flipped == 1);
  }
}

TEST_CASE("Unit, up and size act on tetrahedra") {
  test::TempFolder folder;
  assets::write_tet_file(folder / "t.msh", test::five_tets());
  assets::MeshOptions options;
  options.unit = 1e-3;
  options.up = 'x';
  const double before = test::volume(test::five_tets());
  CHECK(test::volume(read_tet_file(folder / "t.msh", options).mesh) == doctest::Approx(before * 1e-9));
}

TEST_CASE("What is wrong with a tetrahedral file is said with its line") {
  test::TempFolder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    const auto file = folder.write(name, text);
    return test::user_error(ErrorKind::kInput, [&] { read_tet_file(file); });
  };
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
  const auto elements = [](const std::string& line) { return "$Elements\n1\n" + line + "\n$EndElements\n"; };
  CHECK(contains(message("a.msh", "hello"), "a.msh:1: does not begin with $MeshFormat"));
  CHECK(contains(message("a.msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n"), "format 4; 2.2 and 4.1 are read"));
  CHECK(contains(message("a.msh", head + "$Nodes\n99999999999\n"),
                 "a.msh:5: the number of nodes is 99999999999, more than"));
  CHECK(contains(message("a.msh", head + "$Nodes\n1\n1 0 0 nan\n$EndNodes\n"),
                 "a.msh:6: 'nan' stands where z should be"));
  CHECK(contains(message("a.msh", head + nodes), "holds no tetrahedra"));
  CHECK(contains(message("a.msh", head + nodes + elements("1 4 0 1 2 3 9")), "names node 9, which is not there"));
  CHECK(contains(message("a.msh", head + nodes + elements("1 4 0 1 2 3 3")), "has no volume"));
  CHECK(contains(message("a.msh", head + nodes + elements("1 5 0 1 2 3 4 1 2 3 4")), "only tetrahedra"));
  CHECK(contains(message("a.msh", head + nodes + elements("1 11 0 1 2 3 4 1 2 3 4 1 1")), "higher order"));
  CHECK(contains(message("a.msh", head + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n"), "node 1 is there twice"));
  CHECK(contains(message("a.mesh", "MeshVersionFormatted 2\nDimension 2\n"), "dimension is not 3"));
  CHECK(contains(message("c.node", "1 3 0 0\n1 0 0 0\n"), "c.ele"));
  folder.write("d.ele", "1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n");
  CHECK(contains(message("d.node", "1 3 0 0\n1 0 0 0\n"), "10 nodes per tetrahedron"));
  CHECK(contains(test::user_error(ErrorKind::kInput, [&] { read_tet_file(folder / "none.msh"); }), "No such file"));
}
