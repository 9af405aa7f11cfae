// softreel turntable MESH
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <future>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/convert.h"
#include "app/drawn_surface.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/turntable_pictures.h"
#include "app/turntable_scene.h"
#include "assets/error.h"
#include "assets/scene.h"
#include "assets/scene_colors.h"
#include "assets/surface_import.h"
#include "assets/tet_file.h"
#include "render/environment.h"
#include "render/renderer.h"

namespace softreel::app {
namespace {

assets::ImportedSurface load(const TurntableArguments& a) {
  const assets::MeshOptions options{1.0, a.up[0], std::nullopt};
  if (assets::is_tet_file(a.mesh)) {
    const sim::TetMesh tets = assets::read_tet_file(a.mesh, options).mesh;
    return assets::surface_from_mesh({tets.vertices, sim::boundary_triangles(tets)});
  }
  assets::ImportLimits limits;
  limits.poll = stop_if_interrupted;
  return assets::import_surface(a.mesh, options, limits);
}

}  // namespace

int run_turntable(const TurntableArguments& a) {
  if (std::filesystem::path(a.mesh).extension() == ".toml") return run_turntable_scene(a);
  use_threads(a.threads);
  const std::filesystem::path output = turntable_output(a);
  assets::Look look;
  if (!a.color.empty()) {
    look.color = assets::parse_color(a.color);
    if (!look.color)
      throw assets::UserError(
          assets::ErrorKind::kUsage,
          fmt::format("--color {}: expected \"#rrggbb\" or a colour's name such as \"red\"", a.color));
  }
  // The mesh is read by a process of its own: meanwhile OSMesa is loaded and its context made.
  std::future<assets::ImportedSurface> loaded = std::async(std::launch::async, load, std::cref(a));
  render::RenderOptions options;
  options.width = a.size[0];
  options.height = a.size[1];
  options.samples = a.samples;
  render::Renderer renderer(options);
  const assets::ImportedSurface surface = loaded.get();
  for (const std::string& name : surface.missing_textures)
    say(a.quiet, fmt::format("note: texture '{}' was not found; drawn without", name));

  std::vector<glm::vec3> points;
  render::Bounds bounds;
  for (const sim::Vec3& p : surface.welded.vertices) points.push_back(to_glm(p));
  bounds.add(points);
  DrawnSurface drawn = drawn_surface({}, surface, static_cast<int>(points.size()), look, {}, true);
  const render::MeshId mesh = renderer.add_mesh(std::move(drawn.mesh), std::move(drawn.looks));
  renderer.set_positions(mesh, points);
  const glm::vec3 axis = bounds.centre();
  const render::Camera camera =
      render::frame_turntable(points, axis, 35, static_cast<float>(a.size[0]) / static_cast<float>(a.size[1]));
  render::Stage stage = render::default_stage(bounds, camera, true, bounds.low.y);
  // As a scene that says nothing of its picture.
  const assets::Render usual;
  stage.environment.sky_shadow = usual.sky_shadow;
  stage.environment.background_top = to_linear(usual.background.top);
  stage.environment.background_bottom = to_linear(usual.background.bottom);
  stage.environment.ground.look.color = to_linear(usual.ground.color);
  stage.environment.ground.look.roughness = static_cast<float>(usual.ground.roughness);
  return write_turntable(a, output, renderer.driver(), [&](double angle) {
    // The mesh turns, the light stays.
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    const Eigen::Vector3d centre(axis.x, axis.y, axis.z);
    turn.linear() = Eigen::AngleAxisd(angle * M_PI / 180, Eigen::Vector3d::UnitY()).toRotationMatrix();
    turn.translation() = centre - turn.linear() * centre;
    renderer.set_transform(mesh, to_glm(turn));
    return renderer.render(camera, stage.lights, stage.environment);
  });
}

}  // namespace softreel::app
