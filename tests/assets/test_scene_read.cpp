#include <doctest/doctest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "assets/scene_names.h"
#include "test_scene_help.h"

namespace softreel::assets {

namespace fs = std::filesystem;

TEST_CASE("a scene file with one body in it is a whole clip") {
  const Scene scene = parse("[[soft]]\nblock = {}\n");
  CHECK(scene.time.frames() == 90);
  CHECK(scene.time.step() == doctest::Approx(1.0 / 120));
  CHECK(scene.gravity == Vec3(0, -9.81, 0));
  REQUIRE(scene.soft.size() == 1);
  CHECK(scene.soft[0].name == "soft-1");
  REQUIRE(scene.soft[0].block);
  CHECK(scene.soft[0].block->cells == std::array{8, 8, 8});
  CHECK(scene.soft[0].material.model == "stable-neo-hookean");
  CHECK(scene.lights.size() == 1);
  CHECK(!scene.camera.position);
  CHECK(scene.render.size == std::array{1280, 720});
  CHECK(scene.render.samples == 16);
}

TEST_CASE("a scene that writes every kind of thing is read as it is written") {
  const Scene scene = parse(R"(
title   = "Spot lands under a sheet"
gravity = [0, -9.81, 0]

[time]
fps        = 30
duration   = 3.0
substeps   = 4
integrator = "implicit-euler"

[solver]
method    = "newton"
linear    = "auto"
tolerance = 1e-3

[[soft]]
name      = "spot"
mesh      = "../meshes/spot.obj"
tetrahedralize = { mode = "conform", quality = 1.4, max_volume = 1e-5 }
material  = { model = "stable-neo-hookean", young = 5e4, poisson = 0.45 }
density   = 1000
translate = [0, 1, 0]
scale     = 2
unit      = "mm"
up        = "z"
look      = { color = "#d9a066", roughness = 0.5 }

[[cloth]]
name      = "sheet"
grid      = { size = [2, 2], cells = [64, 64] }
model     = "membrane"
material  = { model = "stvk", young = 1e5, poisson = 0.3, thickness = 1e-3, bending = 1e-4 }
density   = 200
translate = [0, 2, 0]
pins      = [ { box = [[-1.01, -1, -1.01], [-0.99, 3, -0.99]], axes = "xz", motion = [{ t = 0 }, { t = 1, translate = [0, 1, 0], rotate = [0, 720, 0] }] } ]

[[collider]]
shape     = "plane"
friction  = 0.4

[contact]
distance   = 2e-3
slip_speed = 1e-3

[camera]
position = [3, 2, 4]
target   = [0, 0.5, 0]
fov      = 40

[[light]]
kind = "area"
position = [3, 5, 2]
radius = 0.5

[render]
size    = [1280, 720]
samples = 16
background = "white"
)");
  CHECK(scene.title == "Spot lands under a sheet");
  const SoftBody& spot = scene.soft.at(0);
  CHECK(spot.name == "spot");
  CHECK(spot.mesh.path == "../meshes/spot.obj");
  CHECK(spot.mesh.unit == 1e-3);
  CHECK(spot.mesh.up == UpAxis::kZ);
  CHECK(!spot.block);
  CHECK(spot.tetrahedralize.max_volume == 1e-5);
  CHECK(spot.material.young == 5e4);
  CHECK(spot.transform.translate == Vec3(0, 1, 0));
  CHECK(spot.transform.scale == Vec3(2, 2, 2));
  CHECK(spot.look.color == Color{0xd9 / 255.0, 0xa0 / 255.0, 0x66 / 255.0});
  const Cloth& sheet = scene.cloth.at(0);
  CHECK(sheet.grid->cells == std::array{64, 64});
  CHECK(sheet.areal_density() == doctest::Approx(0.2));
  const Pin& pin = sheet.pins.at(0);
  CHECK(pin.box->lo == Vec3(-1.01, -1, -1.01));
  CHECK(pin.axes == std::array{true, false, true});
  CHECK(pin.motion.at(1).rotate == Vec3(0, 720, 0));
  CHECK(scene.colliders.at(0).name == "collider-1");
  CHECK(name_of(scene.colliders.at(0).shape) == "plane");
  CHECK(scene.camera.position == Vec3(3, 2, 4));
  CHECK(scene.lights.at(0).radius == 0.5);
  CHECK(scene.render.background.top == scene.render.background.bottom);
}

TEST_CASE("a material's name stands for its figures, and keys beside it go first") {
  const Scene scene = parse(R"(
[[soft]]
block = {}
material = "steel"
[[soft]]
block = {}
material = { young = 1e6, preset = "steel" }
density = 10
[[cloth]]
grid = {}
material = "denim"
)");
  CHECK(scene.soft[0].material.young == 2.1e11);
  CHECK(scene.soft[0].density == 7850);
  CHECK(scene.soft[1].material.young == 1e6);
  CHECK(scene.soft[1].material.poisson == 0.3);
  CHECK(scene.soft[1].density == 10);
  CHECK(scene.cloth[0].areal_density() == doctest::Approx(0.4));
}

TEST_CASE("an empty light list is a scene without lights") {
  CHECK(parse("light = []\n[[soft]]\nblock = {}\n").lights.empty());
  CHECK(parse("[[soft]]\nblock = {}\n[[light]]\nkind = 'sun'\n[[light]]\n").lights.size() == 2);
}

TEST_CASE("a plane's normal comes out with length one") {
  const Scene scene = parse("[[soft]]\nblock = {}\n[[collider]]\nnormal = [0, 3, 4]\n");
  CHECK(scene.colliders[0].normal.isApprox(Vec3(0, 0.6, 0.8)));
}

TEST_CASE("the ground is switched with words or with true and false") {
  const std::string body = "[[soft]]\nblock = {}\n[render]\n";
  CHECK(parse(body + "ground = false").render.ground.show == GroundMode::kOff);
  CHECK(parse(body + "ground = 'on'").render.ground.show == GroundMode::kOn);
  CHECK(parse(body + "ground = { color = 'red' }").render.ground.show == GroundMode::kAuto);
}

TEST_CASE("assets are listed with the place that names them, and are relative to the scene file") {
  const Scene scene =
      parse_scene("[[soft]]\nname = 'a'\nmesh = '../m/a.obj'\nlook = { texture = 'b.png' }\n", "some/scenes/x.toml");
  REQUIRE(scene.assets.size() == 2);
  CHECK(scene.assets[0].key == "soft.a.mesh");
  CHECK(scene.assets[0].physics);
  CHECK(scene.assets[0].line == 3);
  CHECK(scene.assets[0].column == 8);
  CHECK(scene.asset_path(scene.assets[0].path) == fs::path("some/m/a.obj"));
  CHECK(!scene.assets[1].physics);
  CHECK(scene.asset_path("/abs/b.png") == fs::path("/abs/b.png"));
}

namespace {
struct Folder {
  fs::path path = fs::temp_directory_path() / ("softreel-scene-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

UserError error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error;
  }
  return UserError(ErrorKind::kOutput, "nothing was thrown");
}
}  // namespace

TEST_CASE("a scene file that cannot be read is an unusable input") {
  const Folder folder;
  folder.write("flag.toml", "[[cloth]]\ngrid = {}\n");
  CHECK(read_scene(folder.path / "flag.toml").cloth.size() == 1);

  const UserError missing = error_of([&] { read_scene(folder.path / "flga.toml"); });
  CHECK(missing.kind() == ErrorKind::kInput);
  CHECK(contains(missing.what(), "did you mean"));
  CHECK(contains(missing.what(), "flag.toml"));
  CHECK(error_of([&] { read_scene(folder.path / "no" / "flag.toml"); }).kind() == ErrorKind::kInput);
  CHECK(contains(error_of([&] { read_scene(folder.path); }).what(), "is a folder"));
  CHECK(contains(error_of([&] { read_scene("/dev/null"); }).what(), "not a plain file"));
  CHECK(error_of([&] { read_scene(""); }).kind() == ErrorKind::kInput);
  CHECK(error_of([&] { read_scene(std::string(10000, 'x')); }).kind() == ErrorKind::kInput);

  const fs::path large = folder.write("large.toml", "");
  fs::resize_file(large, 17 << 20);
  CHECK(contains(error_of([&] { read_scene(large); }).what(), "too many for a scene file"));
}

TEST_CASE("meshes and textures that are not there are all named, each with the place that asks for it") {
  const Folder folder;
  folder.write("cow.obj", "");
  const fs::path file = folder.write(
      "scene.toml", "[[soft]]\nmesh = 'cwo.obj'\n[[soft]]\nmesh = 'cow.obj'\nlook = { texture = 'no/skin.png' }\n");
  const UserError error = error_of([&] { check_assets(read_scene(file)); });
  CHECK(error.kind() == ErrorKind::kInput);
  REQUIRE(error.problems().size() == 2);
  CHECK(error.problems()[0].line == 2);
  CHECK(contains(error.problems()[0].message, "cow.obj"));
  CHECK(contains(error.problems()[1].message, "there is no folder"));
}

TEST_CASE("a material without a volume term notes that Poisson's ratio does not act as one") {
  const Scene given =
      parse("[[soft]]\nblock = {}\nmaterial = { model = \"corotated\", young = 1.3e4, poisson = 0.3 }\n");
  REQUIRE(given.notes.size() == 1);
  CHECK(given.notes[0].find(":3:") != std::string::npos);
  CHECK(given.notes[0].find("material.poisson: ") != std::string::npos);
  CHECK(given.notes[0].find("young = 1e+04") != std::string::npos);
  CHECK(parse("[[soft]]\nblock = {}\nmaterial = { model = \"corotated\", preset = \"jelly\" }\n").notes.size() == 1);
  CHECK(parse("[[cloth]]\ngrid = {}\nmaterial = { model = \"corotated\" }\n").notes.size() == 1);
  CHECK(parse("[[soft]]\nblock = {}\nmaterial = { model = \"corotated\", poisson = 0 }\n").notes.empty());
  CHECK(parse("[[soft]]\nblock = {}\nmaterial = { poisson = 0.3 }\n").notes.empty());
}

}  // namespace softreel::assets
