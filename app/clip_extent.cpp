#include "app/clip_extent.h"

#include <algorithm>

#include "app/convert.h"
#include "app/drawn_bodies.h"
#include "app/placement.h"
#include "app/world.h"

namespace softreel::app {
namespace {

render::Bounds moved(const render::Shape& shape, const Eigen::Isometry3d& pose) {
  const glm::mat4 m = to_glm(pose);
  render::Bounds local, world;
  local.add(shape.positions);
  for (int corner = 0; corner < 8; ++corner)
    world.add(glm::vec3(m * glm::vec4(corner & 1 ? local.high.x : local.low.x, corner & 2 ? local.high.y : local.low.y,
                                      corner & 4 ? local.high.z : local.low.z, 1)));
  return world;
}

render::Bounds box_around(const Eigen::VectorXd& x, int first, int count) {
  render::Bounds box;
  for (int i = first; i < first + count; ++i) box.add(to_glm(Eigen::Vector3d(x.segment<3>(3 * i))));
  return box;
}

void add_figures(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& frame, ClipExtent& extent) {
  if (extent.figures.empty()) {
    int first = 0;
    const auto make = [&](const auto& bodies, const auto& of) {
      for (size_t i = 0; i < bodies.size(); ++i) {
        extent.figures.push_back(bodies[i].data ? std::make_shared<const BodyFigure>(bodies[i], of[i], first)
                                                : nullptr);
        first += static_cast<int>(of[i].rest.vertices.size());
      }
    };
    make(scene.soft, shapes.soft);
    make(scene.cloth, shapes.cloth);
    extent.figure_ranges.resize(extent.figures.size());
  }
  for (size_t i = 0; i < extent.figures.size(); ++i)
    if (extent.figures[i]) extent.figure_ranges[i].add(extent.figures[i]->values(frame));
}

}  // namespace

bool needs_whole_clip(const assets::Scene& scene) {
  const bool camera = !scene.camera.position || !scene.camera.target;
  const bool ground = scene.render.ground.show != assets::GroundMode::kOff && !scene.render.ground.height;
  const bool light = std::any_of(scene.lights.begin(), scene.lights.end(), [](const assets::Light& l) {
    return l.kind != assets::LightKind::kSun &&
           (!l.position || (l.kind == assets::LightKind::kArea ? !l.radius : !l.size));
  });
  const bool range =
      std::any_of(scene.fields.begin(), scene.fields.end(), [](const assets::Field& f) { return !f.range; });
  const auto open_data = [](const assets::Body& b) { return b.data && !b.data->range; };
  const bool data = std::any_of(scene.soft.begin(), scene.soft.end(), open_data) ||
                    std::any_of(scene.cloth.begin(), scene.cloth.end(), open_data);
  return camera || ground || light || range || data;
}

void ClipExtent::add(const render::Bounds& box) {
  if (box.empty()) return;
  bounds.add(box);
  for (int corner = 0; corner < 8; ++corner)
    points.emplace_back(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                        corner & 4 ? box.high.z : box.low.z);
}

void add_frame(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& frame, ClipExtent& extent) {
  const sim::State& state = frame.state;
  for_each_body(scene, shapes, [&](const assets::Body& body, const BodySurface& drawn, int first, bool) {
    if (body.visible) extent.add(box_around(state.x, first, drawn.position_count));
  });
  for_each_net(scene, shapes, [&](const assets::SpringBody&, const BallsAndRods& drawn, int first) {
    render::Bounds box;
    for (size_t i = 0; i < drawn.radii().size(); ++i) {
      const glm::vec3 p = to_glm(Eigen::Vector3d(state.x.segment<3>(3 * (first + static_cast<int>(i)))));
      const glm::vec3 r(static_cast<float>(drawn.radii()[i]));
      box.add(p - r);
      box.add(p + r);
    }
    extent.add(box);
  });
  add_figures(scene, shapes, frame, extent);
  extent.field_ranges.resize(scene.fields.size());
  for (size_t i = 0; i < scene.fields.size(); ++i) {
    render::Bounds box;
    box.add(FieldSurface(scene.fields[i], shapes.fields[i]).positions(frame.fields.at(i).value));
    extent.add(box);
    extent.field_ranges[i].add(frame.fields[i].value);
  }
  for (size_t i = 0; i < scene.colliders.size(); ++i) {
    const assets::Collider& c = scene.colliders[i];
    if (!c.visible || c.shape == assets::ColliderShape::kPlane) continue;
    if (c.shape == assets::ColliderShape::kMesh) {
      const Eigen::Isometry3d pose = make_collider(c).motion.pose(state.t);
      render::Bounds box;
      for (const sim::Vec3& v : shapes.colliders[i]->rest.vertices) box.add(to_glm(Eigen::Vector3d(pose * v)));
      extent.add(box);
    } else {
      extent.add(moved(shape_of(c, 1), make_collider(c).pose(state.t)));
    }
  }
}

}  // namespace softreel::app
