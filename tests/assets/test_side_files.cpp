#include "assets/side_files.h"

#include <algorithm>

#include "tests/assets/support.h"

using namespace softreel;

namespace {

/// "name" or "name (physics)", sorted.
std::vector<std::string> names(const std::filesystem::path& mesh) {
  std::vector<std::string> result;
  for (const assets::SideFile& side : assets::side_files(mesh))
    result.push_back(side.path.filename().string() + (side.physics ? " (physics)" : ""));
  std::sort(result.begin(), result.end());
  return result;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("A glTF file refers to its buffers and pictures, also with blanks in their names") {
  test::TempFolder folder;
  folder.write("my data.bin", "b");
  folder.write("skin.PNG", "p");
  folder.write("other.bin", "not named");
  const auto mesh = folder.write("a.gltf", R"({"buffers":[{"uri":"my%20data.bin"}],"images":[{"uri":"skin.PNG"}]})");
  CHECK(names(mesh) == Names{"my data.bin (physics)", "skin.PNG"});
}

TEST_CASE("An OBJ refers to its materials and through them to textures, wherever the importer finds them") {
  test::TempFolder folder;
  std::filesystem::create_directories(folder / "textures");
  folder.write("a.mtl", "newmtl a\r\nmap_Kd -clamp on C:\\work\\wood grain.jpg\r\nmap_Bump none.png\r\n");
  folder.write("textures/wood grain.jpg", "j");
  CHECK(names(folder.write("a.obj", "mtllib a.mtl\nv 0.5 1.25 0\n")) == Names{"a.mtl", "wood grain.jpg"});
}

TEST_CASE("A mesh without references has no side files") {
  test::TempFolder folder;
  folder.write("a.mtl", "newmtl a\n");
  CHECK(names(folder.write("a.obj", "v 0.5 1.25 0\n")).empty());
  CHECK(names(folder.write("noise.stl", std::string(3000, '.') + ".bin" + std::string(2000, 'a') + ".png")).empty());
}

TEST_CASE("Either half of a .node/.ele pair refers to the other") {
  test::TempFolder folder;
  const auto node = folder.write("t.node", "0"), ele = folder.write("t.ele", "0");
  CHECK(names(node) == Names{"t.ele (physics)"});
  CHECK(names(ele) == Names{"t.node (physics)"});
  CHECK(names(folder.write("alone.node", "0")).empty());
}

TEST_CASE("Material files that name each other do not go round for ever") {
  test::TempFolder folder;
  folder.write("a.mtl", "b.mtl\n");
  folder.write("b.mtl", "a.mtl\n");
  CHECK(names(folder.write("a.obj", "mtllib a.mtl\n")) == Names{"a.mtl", "b.mtl"});
}
