#include "app/features.h"

#include "assets/atomic_file.h"

namespace softreel::app {

using namespace std::string_view_literals;

const std::string_view kBaseScene = R"(title = "Base"
[time]
duration = 0.1
substeps = 2
integrator = "symplectic-euler"
[[cloth]]
name = "sheet"
grid = { size = [1, 1], cells = [6, 6] }
material = { model = "stvk", young = 1e4, poisson = 0.3, thickness = 1e-3, bending = 0 }
spin = [0, 90, 0]
[camera]
position = [0, 1, 3]
target = [0, 0, 0]
[[light]]
kind = "sun"
shadow = false
[render]
size = [32, 24]
samples = 1
ground = { show = "off" }
sky_shadow = false
)";

const std::vector<std::string_view> kBaseFeatures = {"membranes", "gravity"};

namespace {

constexpr std::string_view kPyramid = R"(v 0 0 0
v 1 0 0
v 0 0 1
v 0 1 0
f 1 2 3
f 1 4 2
f 1 3 4
f 2 4 3
)";

constexpr std::string_view kBlock = R"([[soft]]
contact = { others = false }
name = "block"
block = { size = [1, 1, 1], cells = [2, 2, 2] }
material = { young = 1e4 }
translate = [0, -2, 0]
)";

/// A second sheet below the first: too far to touch, near enough to be looked at.
constexpr std::string_view kSecondSheet = R"([[cloth]]
name = "below"
grid = { size = [1, 1], cells = [6, 6] }
material = { model = "stvk", young = 1e4, bending = 0 }
translate = [0, -2.5e-3, 0]
)";
constexpr std::string_view kSecondSheetApart = R"([[cloth]]
name = "below"
contact = { others = false }
grid = { size = [1, 1], cells = [6, 6] }
material = { model = "stvk", young = 1e4, bending = 0 }
translate = [0, -2.5e-3, 0]
)";

constexpr std::string_view kNet = R"([[cloth]]
name = "net"
model = "mass-spring"
contact = { others = false }
grid = { size = [1, 1], cells = [4, 4] }
material = { young = 1e4 }
translate = [0, -1, 0]
)";

/// A square with texture coordinates; its picture has two by two pixels.
constexpr std::string_view kTextured = R"([[cloth]]
name = "picture"
mesh = "square.obj"
contact = { others = false }
translate = [0, -0.5, 0]
material = { young = 1e4, bending = 0 }
look = { texture = "checks.tga" }
)";
constexpr std::string_view kSquare = R"(v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 4/4 3/3
f 1/1 3/3 2/2
)";
/// Targa, the simplest of all that can be read: header, then blue, green, red.
constexpr std::string_view kChecks =
    "\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0"
    "abcdefghijkl"sv;

const std::vector<Feature> kFeatures = {
    {.name = "gravity", .code = {"sim/gravity"}},
    {.name = "membranes", .code = {"sim/membrane"}},
    {.name = "weightless", .code = {}, .overrides = {"gravity=[0,0,0]"}, .without = {"gravity"}},
    {.name = "tetrahedral solids", .code = {"sim/solid"}, .scene = kBlock},
    {.name = "tetrahedralization (TetGen)",
     .code = {"assets/tetrahedralize", "assets/tetgen_task", "assets/tet_cache"},
     .brings = {"tetrahedral solids"},
     .against = "tetrahedral solids",
     .scene = "[[soft]]\ncontact = { others = false }\nmesh = \"pyramid.obj\"\nmaterial = { young = 1e4 }\n",
     .files = {{"pyramid.obj", kPyramid}},
     .stats = {"seconds.tetrahedralize"},
     .whole_run = true},
    {.name = "bending", .code = {"sim/bending"}, .overrides = {"cloth.sheet.material.bending=1e-5"}},
    {.name = "springs", .code = {"sim/springs"}, .scene = kNet},
    {.name = "points", .code = {"app/balls_and_rods"}, .brings = {"springs"}, .scene = "[[springs]]\nchain = {}\n"},
    {.name = "loads",
     .code = {"sim/load"},
     .scene = "[[load]]\nbody = \"sheet\"\nbox = [[-1, -1, -1], [0, 1, 0]]\nforce = [0, 0.1, 0]\n"},
    {.name = "attachments",
     .code = {"sim/attachment", "sim/nearest_point"},
     .brings = {"points", "springs"},
     .against = "points",
     .scene = "[[springs]]\nname = \"rope\"\nchain = { from = [0, 0, 0], to = [0, -1, 0] }\n"
              "[[attach]]\nbodies = [\"rope\", \"sheet\"]\nnear = 0.01\n"},
    {.name = "wind", .code = {"sim/wind"}, .scene = "[wind]\nvelocity = [1, 0, 0]\n"},
    {.name = "drag", .code = {"sim/drag"}, .scene = "[damping]\ndrag = 0.1\n"},
    {.name = "damping by stiffness", .code = {"sim/stiffness_damping"}, .scene = "[damping]\nbeta = 1e-4\n"},
    {.name = "damping of springs",
     .code = {"sim/spring_damping"},
     .brings = {"springs"},
     .against = "springs",
     .overrides = {"cloth.net.spring_damping=1e-3"},
     .scene = kNet},
    {.name = "pins",
     .code = {"softreel::sim::Pins::place", "softreel::sim::Pins::drive"},
     .overrides = {"cloth.sheet.pins=[{vertices=[0]}]"}},
    {.name = "driven motion",
     .code = {"softreel::sim::Motion::at", "softreel::sim::Motion::Motion("},
     .brings = {"pins"},
     .against = "pins",
     .overrides = {"cloth.sheet.pins=[{vertices=[0],motion=[{t=0},{t=0.1,translate=[0,0.01,0]}]}]"}},
    {.name = "contact with colliders",
     .code = {"sim/collider", "sim/collider_contact", "sim/collider_core"},
     .overrides = {"cloth.sheet.translate=[0,0.01,0]", "contact.sleep_speed=0"},
     .scene = "[[collider]]\nfriction = 0\n",
     .stats = {"simulate_seconds.contact"}},
    {.name = "sleeping bodies",
     .code = {"sim/sleep"},
     .brings = {"contact with colliders"},
     .against = "contact with colliders",
     .overrides = {"cloth.sheet.translate=[0,0.01,0]"},
     .scene = "[[collider]]\nfriction = 0\n",
     .stats = {"per_frame.asleep"}},
    {.name = "friction",
     .code = {"sim/collider_friction"},
     .brings = {"contact with colliders"},
     .against = "contact with colliders",
     .overrides = {"cloth.sheet.translate=[0,0.01,0]", "contact.sleep_speed=0"},
     .scene = "[[collider]]\nfriction = 0.4\n",
     .stats = {"simulate_seconds.contact"}},
    {.name = "second sheet", .code = {}, .scene = kSecondSheetApart},
    {.name = "contact between surfaces",
     .code = {"sim/surface_contact", "sim/surface_friction", "sim/contact_candidates", "sim/contact_surfaces",
              "sim/box_tree", "sim/free_path", "sim/closest_points", "app/touching_surfaces"},
     .brings = {"second sheet"},
     .against = "second sheet",
     .overrides = {"contact.sleep_speed=0"},
     .scene = kSecondSheet,
     .stats = {"contact", "simulate_seconds.contact"}},
    {.name = "contact of a sheet with itself",
     .code = {},
     .brings = {"contact between surfaces"},
     .overrides = {"cloth.sheet.contact.self=true", "contact.sleep_speed=0"}},
    {.name = "Hessians and a linear solver",
     .code = {"sim/hessian_assembler", "sim/cholmod_factor"},
     .brings = {"implicit steps"},
     .overrides = {"time.integrator=\"implicit-euler\""},
     .stats = {"simulate_seconds.assemble", "simulate_seconds.solve", "solver.chosen"}},
    {.name = "implicit steps",
     .code = {"sim/incremental_potential", "sim/minimizers/newton", "sim/start_guess"},
     .brings = {"Hessians and a linear solver"},
     .overrides = {"time.integrator=\"implicit-euler\""}},
    {.name = "consistent mass",
     .code = {"sim/mass_correction"},
     .shares_code = {"Hessians and a linear solver"},
     .overrides = {"cloth.sheet.mass=\"consistent\""}},
    {.name = "scalar fields",
     .code = {"sim/field", "sim/field_assembly", "sim/field_solver", "app/field_world"},
     .shares_code = {"Hessians and a linear solver"},
     .scene = "[[field]]\ngrid = { cells = [4, 4] }\nfixed = [{ boundary = true, value = \"x\" }]\ncolorbar = false\n"},
    {.name = "stability before the run",
     .code = {"app/forecast", "sim/linearization", "sim/lanczos"},
     .shares_code = {"Hessians and a linear solver"},
     .checked = true,
     .whole_run = true},
    {.name = "estimate of the error in time",
     .code = {"sim/adaptive_plan", "sim/adaptive_figures", "app/accurate_clip"},
     .shares_code = {"Hessians and a linear solver", "stability before the run"},
     .overrides = {"time.accuracy=\"1 cm\""},
     .stats = {"accuracy"},
     .whole_run = true},
    {.name = "exported meshes",
     .code = {"app/export_clip", "assets/export_ply"},
     .options = {"--export", "ply"},
     .whole_run = true},
    {.name = "stats", .code = {"softreel::app::write_stats"}, .options = {"--stats", "@stats.json"}},
    {.name = "shadow maps",
     .code = {"render/shadow_maps", "render/shadow_frustum"},
     .overrides = {"light.1.shadow=true"},
     .stats = {"render_counters.shadow_maps", "render_counters.shadow_passes"},
     .drawn = true},
    {.name = "accumulation buffer",
     .code = {},
     .overrides = {"render.samples=4"},
     .stats = {"render_counters.accumulation_buffers"},
     .drawn = true},
    {.name = "figures as colours",
     .code = {"app/body_figure"},
     .overrides = {"cloth.sheet.data.show=strain", "cloth.sheet.data.colorbar=false"},
     .drawn = true},
    {.name = "colour bars",
     .code = {"render/color_bar", "render/text"},
     .brings = {"scalar fields"},
     .shares_code = {"Hessians and a linear solver"},
     .against = "scalar fields",
     .scene = "[[field]]\ngrid = { cells = [4, 4] }\nfixed = [{ boundary = true, value = \"x\" }]\n",
     .drawn = true},
    {.name = "textures",
     .code = {"render/image_io"},
     .scene = kTextured,
     .files = {{"square.obj", kSquare}, {"checks.tga", kChecks}},
     .stats = {"render_counters.textures"},
     .drawn = true},
    {.name = "shadows of the sky",
     .code = {},
     .overrides = {"render.sky_shadow=true"},
     .stats = {"render_counters.shadow_maps", "render_counters.shadow_passes"},
     .drawn = true},
    {.name = "motion blur",
     .code = {},
     .brings = {"accumulation buffer"},
     .against = "accumulation buffer",
     .overrides = {"render.samples=4", "render.shutter=0.5"},
     .drawn = true},
    {.name = "depth of field",
     .code = {},
     .brings = {"accumulation buffer"},
     .against = "accumulation buffer",
     .overrides = {"render.samples=4", "camera.aperture=0.05"},
     .drawn = true},
    {.name = "side channels",
     .code = {"render/channels", "render/png16"},
     .overrides = {"render.depth=true"},
     .drawn = true},
    {.name = "sheen", .code = {}, .overrides = {"cloth.sheet.look.sheen=0.5"}, .drawn = true},
    {.name = "patterns", .code = {}, .overrides = {"cloth.sheet.look.pattern=\"checker\""}, .drawn = true},
    {.name = "edges of triangles", .code = {}, .overrides = {"cloth.sheet.look.wire=\"black\""}, .drawn = true},
    {.name = "video", .code = {"app/video"}, .options = {"--video", "@clip.mp4"}, .drawn = true, .whole_run = true},
};

}  // namespace

std::span<const Feature> features() { return kFeatures; }

std::filesystem::path write_feature_scene(const Feature* feature, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string text(kBaseScene);
  if (feature) {
    text += feature->scene;
    for (const auto& [name, content] : feature->files) assets::write_file_atomically(folder / name, content);
  }
  assets::write_file_atomically(folder / "scene.toml", text);
  return folder / "scene.toml";
}

std::vector<std::string> feature_arguments(const Feature* feature, const std::filesystem::path& scene) {
  std::vector<std::string> arguments{feature && feature->drawn ? "render" : "simulate", scene.string()};
  if (!feature || !feature->checked) arguments.emplace_back("--force");
  if (!feature) return arguments;
  for (const std::string_view key : feature->overrides) {
    arguments.emplace_back("--set");
    arguments.emplace_back(key);
  }
  for (const std::string_view option : feature->options)
    arguments.push_back(option.starts_with('@') ? (scene.parent_path() / option.substr(1)).string()
                                                : std::string(option));
  return arguments;
}

}  // namespace softreel::app
