// Truncated, damaged and random files of every mesh format: an error for the user or a valid mesh, nothing else.
#include <assimp/scene.h>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>

#include <chrono>
#include <random>

#include "assets/export_pc2.h"
#include "assets/export_ply.h"
#include "assets/surface_import.h"
#include "assets/tet_file.h"
#include "tests/assets/support.h"

using namespace softreel;

namespace {

/// Valid files of every format, by name.
std::map<std::string, std::string> surface_files(const test::TempFolder& folder) {
  const auto ball = test::sphere(1);
  assets::write_obj(folder / "ball.obj", ball.vertices, ball.triangles);
  const std::map<std::string, std::string> ids = {
      {"b.ply", "plyb"}, {"a.ply", "ply"}, {"b.stl", "stlb"}, {"a.stl", "stl"},     {"a.gltf", "gltf2"},
      {"a.glb", "glb2"}, {"b.fbx", "fbx"}, {"a.fbx", "fbxa"}, {"a.dae", "collada"}, {"a.3ds", "3ds"},
      {"a.3mf", "3mf"},  {"a.x", "x"},     {"a.x3d", "x3d"}};
  std::map<std::string, std::string> files = {{"ball.obj", test::slurp(folder / "ball.obj")}};
  for (const auto& [name, id] : ids) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder / "ball.obj").string(), 0);
    REQUIRE(scene);
    REQUIRE(Assimp::Exporter().Export(scene, id, (folder / name).string()) == AI_SUCCESS);
    files[name] = test::slurp(folder / name);
  }
  std::string off = "OFF\n18 32 0\n";
  for (const auto& p : ball.vertices) {
    off += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  }
  for (const auto& t : ball.triangles) {
    off += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  files["a.off"] = off;
  return files;
}

std::string random_bytes(std::size_t n, std::mt19937& random) {
  std::string bytes(n, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  return bytes;
}

/// Cut short, with damaged bytes, with digits changed, with a random end.
std::vector<std::string> broken(const std::string& good, int each, std::mt19937& random) {
  std::vector<std::string> files = {random_bytes(1, random), random_bytes(5000, random)};
  for (int i = 0; i < each; ++i) {
    files.push_back(good.substr(0, good.size() * static_cast<std::size_t>(i + 1) / static_cast<std::size_t>(each + 1)));
    std::string damaged = good;
    for (int k = 0; k <= i; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    files.push_back(damaged);
    std::string digits = good;
    for (int k = 0; k < 20; ++k) {
      char& c = digits[random() % digits.size()];
      if (c >= '0' && c <= '9') c = static_cast<char>('0' + random() % 10);
      if (c == ' ' && k == 0) c = '9';
    }
    files.push_back(digits);
    const std::size_t half = random() % good.size();
    files.push_back(good.substr(0, half) + random_bytes(200, random));
  }
  return files;
}

}  // namespace

TEST_CASE("Broken surface files are errors or meshes, never a crash or a hang") {
  test::TempFolder folder;
  std::mt19937 random(7);
  assets::ImportLimits limits;
  limits.seconds = 5;
  int errors = 0, meshes = 0, crashes = 0;
  for (const auto& [name, good] : surface_files(folder)) {
    {
      INFO(name);
      folder.write("good-" + name, good);
      // The glTF's buffer has the name of the export, see below; assimp does not read the binary FBX it writes.
      if (name == "a.gltf") continue;
      if (name != "b.fbx") CHECK_NOTHROW(assets::import_surface(folder / ("good-" + name)));
    }
    for (const std::string& bytes : broken(good, 5, random)) {
      const auto file = folder.write("broken-" + name, bytes);
      const auto start = std::chrono::steady_clock::now();
      try {
        const auto s = assets::import_surface(file, {}, limits);
        ++meshes;
        CHECK(!s.triangles.empty());
        for (const auto& p : s.welded.vertices) CHECK(p.allFinite());
      } catch (const assets::UserError& error) {
        ++errors;
        CHECK(error.kind() == assets::ErrorKind::kInput);
        CHECK(test::contains(error.what(), file.string()));
        if (test::contains(error.what(), "crashed") || test::contains(error.what(), "took longer") ||
            test::contains(error.what(), "out of memory")) {
          ++crashes;
        }
      }
      CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
    }
  }
  MESSAGE("errors " << errors << ", of these crashes of the importer " << crashes << "; still meshes " << meshes);
  CHECK(errors > 100);
}

TEST_CASE("A broken glTF beside its buffer is an error or a mesh") {
  test::TempFolder folder;
  std::mt19937 random(8);
  const auto files = surface_files(folder);
  for (const std::string& bytes : broken(files.at("a.gltf"), 10, random)) {
    folder.write("a.gltf", bytes);
    try {
      const auto s = assets::import_surface(folder / "a.gltf");
      CHECK(!s.triangles.empty());
    } catch (const assets::UserError& error) {
      CHECK(error.kind() == assets::ErrorKind::kInput);
    }
  }
  folder.write("a.gltf", files.at("a.gltf"));
  CHECK(assets::import_surface(folder / "a.gltf").triangles.size() == 32);
}

TEST_CASE("Broken tetrahedral files are errors or meshes") {
  test::TempFolder folder;
  std::mt19937 random(9);
  const auto mesh = test::five_tets();
  std::map<std::string, std::string> files;
  for (const bool binary : {false, true}) {
    for (const auto version : {assets::MshVersion::k22, assets::MshVersion::k41}) {
      assets::write_tet_file(folder / "t.msh", mesh, binary, version);
      files[std::string(binary ? "b" : "a") + (version == assets::MshVersion::k22 ? "2.msh" : "4.msh")] =
          test::slurp(folder / "t.msh");
    }
  }
  for (const char* name : {"t.mesh", "t.node"}) {
    assets::write_tet_file(folder / name, mesh);
    files[name] = test::slurp(folder / name);
  }
  files["t.ele"] = test::slurp(folder / "t.ele");
  const auto check = [&](const std::filesystem::path& file) {
    try {
      const auto read = assets::read_tet_file(file);
      CHECK(!read.mesh.tets.empty());
      CHECK(test::volume(read.mesh) > 0);
      return true;
    } catch (const assets::UserError& error) {
      CHECK(error.kind() == assets::ErrorKind::kInput);
      return false;
    }
  };
  for (const auto& [name, good] : files) {
    INFO(name);
    CHECK(check(folder.write(name, good)));
    for (std::size_t length = 0; length + 2 < good.size(); ++length) {
      const bool accepted = check(folder.write(name, good.substr(0, length)));
      // Text may lose its end mark ("End") or the last digits of a number; no format may lose an element.
      if (accepted && length + 20 < good.size()) FAIL_CHECK(name << " cut at " << length << " of " << good.size());
    }
    for (const std::string& bytes : broken(good, 300, random)) check(folder.write(name, bytes));
    folder.write(name, good);
  }
}
