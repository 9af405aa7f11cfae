// softreel turntable MESH
#include <fmt/format.h>

#include <cmath>

#include "app/arguments.h"
#include "app/clip_run.h"
#include "app/convert.h"
#include "app/drawn_surface.h"
#include "app/exit_code.h"
#include "app/frame_range.h"
#include "app/interrupt.h"
#include "app/output_check.h"
#include "app/progress.h"
#include "app/turntable_scene.h"
#include "app/video.h"
#include "assets/error.h"
#include "assets/scene_colors.h"
#include "assets/surface_import.h"
#include "assets/tet_file.h"
#include "render/environment.h"
#include "render/frame_writer.h"
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
  if (!a.video.empty()) check_video(a.video);
  const std::filesystem::path output =
      a.output.empty() ? std::filesystem::path("out") / (std::filesystem::path(a.mesh).stem().string() + "-turntable")
                       : std::filesystem::path(a.output);
  assets::Look look;
  if (!a.color.empty()) {
    look.color = assets::parse_color(a.color);
    if (!look.color)
      throw assets::UserError(
          assets::ErrorKind::kUsage,
          fmt::format("--color {}: expected \"#rrggbb\" or a colour's name such as \"red\"", a.color));
  }
  check_output_folder(output);
  const assets::ImportedSurface surface = load(a);
  for (const std::string& name : surface.missing_textures)
    say(a.quiet, fmt::format("note: texture '{}' was not found; drawn without", name));

  std::vector<glm::vec3> points;
  render::Bounds bounds;
  for (const sim::Vec3& p : surface.welded.vertices) points.push_back(to_glm(p));
  bounds.add(points);
  render::RenderOptions options;
  options.width = a.size[0];
  options.height = a.size[1];
  options.samples = a.samples;
  render::Renderer renderer(options);
  DrawnSurface drawn = drawn_surface({}, surface, static_cast<int>(points.size()), look, {}, true);
  const render::MeshId mesh = renderer.add_mesh(std::move(drawn.mesh), std::move(drawn.looks));
  renderer.set_positions(mesh, points);
  const glm::vec3 axis = bounds.centre();
  const render::Camera camera =
      render::frame_turntable(points, axis, 35, static_cast<float>(a.size[0]) / static_cast<float>(a.size[1]));
  const render::Stage stage = render::default_stage(bounds, camera, true, bounds.low.y);

  render::FrameWriter writer(1);
  std::vector<std::filesystem::path> files;
  {
    Progress progress("turntable", a.count, a.quiet);
    for (int i = 0; i < a.count && !interrupted(); ++i) {
      // The mesh turns, the light stays; picture `count` would be picture 0 again.
      const double angle = 2 * M_PI * i / a.count;
      Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
      const Eigen::Vector3d centre(axis.x, axis.y, axis.z);
      turn.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
      turn.translation() = centre - turn.linear() * centre;
      renderer.set_transform(mesh, to_glm(turn));
      files.push_back(output / frame_file_name(i + 1));
      writer.write(files.back(), renderer.render(camera, stage.lights, stage.environment),
                   {{"Software", "softreel " + version()},
                    {"softreel:frame", std::to_string(i + 1)},
                    {"softreel:driver", renderer.driver()}});
      progress.advance();
    }
  }
  writer.finish();
  stop_if_interrupted();
  if (!a.video.empty()) write_video(a.video, files, a.fps);
  if (!a.quiet) fmt::print("{}\n{}\n", files.front().string(), a.video.empty() ? files.back().string() : a.video);
  return kDone;
}

}  // namespace softreel::app
