#include "app/stage.h"

#include <algorithm>
#include <cmath>

#include "app/convert.h"
#include "app/drawn_surface.h"
#include "app/placement.h"
#include "app/world.h"

namespace softreel::app {
namespace {

std::optional<std::filesystem::path> texture_path(const assets::Scene& scene, const assets::Look& look) {
  if (look.texture.empty()) return std::nullopt;
  return scene.asset_path(look.texture);
}

glm::vec3 to_vec(const sim::Vec3& v) { return to_glm(Eigen::Vector3d(v)); }

/// A plane that lies still and level is the ground; others are drawn as a large sheet.
bool is_level(const assets::Collider& c) {
  if (c.shape != assets::ColliderShape::kPlane || !c.motion.empty()) return false;
  const sim::Collider plane = make_collider(c);
  return plane.world_from_shape.linear().col(1).y() > 1 - 1e-9;
}

render::Shape shape_of(const assets::Collider& c, const ClipExtent& extent) {
  const float scale = static_cast<float>(c.transform.scale.x());
  switch (c.shape) {
    case assets::ColliderShape::kSphere:
      return render::make_sphere(static_cast<float>(c.radius) * scale);
    case assets::ColliderShape::kBox:
      return render::make_box(to_vec(c.transform.scale.cwiseProduct(c.size)));
    case assets::ColliderShape::kCapsule:
      return render::make_capsule(static_cast<float>(c.radius) * scale, static_cast<float>(c.height) * scale);
    case assets::ColliderShape::kPlane:
    case assets::ColliderShape::kMesh:
      break;
  }
  const float side = std::max(6.0f * extent.bounds.radius(), 1.0f);
  return render::make_plane(side, side);
}

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

/// Calls each(body, drawn surface, first vertex, is cloth) in the order of the state.
template <class Each>
void for_each_body(const assets::Scene& scene, const Shapes& shapes, const Each& each) {
  int first = 0;
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    each(static_cast<const assets::Body&>(scene.soft[i]), shapes.soft[i].drawn, first, false);
    first += static_cast<int>(shapes.soft[i].rest.vertices.size());
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i) {
    each(static_cast<const assets::Body&>(scene.cloth[i]), shapes.cloth[i].drawn, first, true);
    first += static_cast<int>(shapes.cloth[i].rest.vertices.size());
  }
}

/// Calls each(body, drawn shape, first vertex) for visible bodies of springs, which come after the others in the state.
template <class Each>
void for_each_net(const assets::Scene& scene, const Shapes& shapes, const Each& each) {
  int first = 0;
  for (const SolidShape& s : shapes.soft) first += static_cast<int>(s.rest.vertices.size());
  for (const ClothShape& c : shapes.cloth) first += static_cast<int>(c.rest.vertices.size());
  for (size_t i = 0; i < scene.springs.size(); ++i) {
    if (shapes.springs[i].drawn) each(scene.springs[i], *shapes.springs[i].drawn, first);
    first += static_cast<int>(shapes.springs[i].rest.size());
  }
}

}  // namespace

bool needs_whole_clip(const assets::Scene& scene) {
  const bool camera = !scene.camera.position || !scene.camera.target;
  const bool ground = scene.render.ground.show != assets::GroundMode::kOff && !scene.render.ground.height;
  const bool light = std::any_of(scene.lights.begin(), scene.lights.end(), [](const assets::Light& l) {
    return l.kind == assets::LightKind::kArea && (!l.position || !l.radius);
  });
  const bool range =
      std::any_of(scene.fields.begin(), scene.fields.end(), [](const assets::Field& f) { return !f.range; });
  return camera || ground || light || range;
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
      for (const sim::Vec3& v : shapes.colliders[i]->rest.vertices) box.add(to_vec(pose * v));
      extent.add(box);
    } else {
      extent.add(moved(shape_of(c, extent), make_collider(c).pose(state.t)));
    }
  }
}

render::Camera camera_of(const assets::Scene& scene, const ClipExtent& extent,
                         const std::vector<render::ColorBar>& color_bars) {
  render::Camera camera;
  const assets::Camera& c = scene.camera;
  const float whole_aspect = static_cast<float>(scene.render.size[0]) / static_cast<float>(scene.render.size[1]);
  // Colour bars take a part of the right side; what is left of it frames the scene.
  const float bars = color_bars.empty() ? 0.0f
                                        : std::min(0.5f, static_cast<float>(render::color_bars_width(
                                                             scene.render.size[0], scene.render.size[1], color_bars)) /
                                                             static_cast<float>(scene.render.size[0]));
  const float aspect = whole_aspect * (1 - bars);
  const float fov = static_cast<float>(c.fov);
  camera.fov = fov;
  camera.up = to_vec(c.up);
  if (c.position) {
    camera.position = to_vec(*c.position);
    camera.target = c.target ? to_vec(*c.target) : extent.bounds.centre();
    return camera;
  }
  const render::Camera framed = render::frame_points(extent.points, fov, aspect, glm::normalize(to_vec(c.direction)));
  if (!c.target) {
    camera = framed;
  } else {
    // Look at the target from as far as the framing asks for.
    camera.target = to_vec(*c.target);
    camera.position =
        camera.target + glm::length(framed.position - framed.target) * glm::normalize(to_vec(c.direction));
  }
  camera.up = to_vec(c.up);
  if (bars > 0 && !c.target) {  // half of that to the side brings the scene into the middle of the rest
    const glm::vec3 ahead = camera.target - camera.position;
    const glm::vec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::vec3 aside = right * (bars * whole_aspect * glm::length(ahead) * std::tan(glm::radians(fov) / 2));
    camera.position += aside;
    camera.target += aside;
  }
  return camera;
}

Stage::Stage(const assets::Scene& scene, const Shapes& shapes, const ClipExtent& extent)
    : scene_(scene),
      renderer_({scene.render.size[0], scene.render.size[1], scene.render.samples,
                 static_cast<std::uint32_t>(scene.render.seed), 0}) {
  add_bodies(shapes);
  add_fields(shapes, extent);
  add_colliders(shapes, extent);
  camera_ = camera_of(scene_, extent, bars_);
  place_lights(extent);
  place_ground(extent);
}

void Stage::add_bodies(const Shapes& shapes) {
  for_each_body(scene_, shapes, [&](const assets::Body& body, const BodySurface& drawn, int first, bool cloth) {
    if (!body.visible) return;
    DrawnSurface d =
        drawn_surface(drawn.surface, drawn.position_count, body.look, texture_path(scene_, body.look), cloth);
    bodies_.push_back({renderer_.add_mesh(std::move(d.mesh), std::move(d.looks)), first, drawn.position_count});
  });
  for_each_net(scene_, shapes, [&](const assets::SpringBody& body, const BallsAndRods& drawn, int first) {
    nets_.push_back({renderer_.add_mesh(drawn.mesh(), {plain_look(body.look, std::nullopt, false)}), first, &drawn});
  });
}

void Stage::add_fields(const Shapes& shapes, const ClipExtent& extent) {
  for (size_t i = 0; i < scene_.fields.size(); ++i) {
    const assets::Field& field = scene_.fields[i];
    DrawnSurface d =
        drawn_surface(shapes.fields[i].drawn.surface, shapes.fields[i].drawn.position_count, {}, std::nullopt, true);
    const std::array<double, 2> range = color_range(field, extent.field_ranges.at(i));
    d.looks.assign(d.looks.size(), field_look(field));
    fields_.push_back(
        {renderer_.add_mesh(std::move(d.mesh), std::move(d.looks)), FieldSurface(field, shapes.fields[i]), range});
    if (field.colorbar) bars_.push_back(color_bar(field, range));
  }
}

void Stage::add_colliders(const Shapes& shapes, const ClipExtent& extent) {
  for (size_t i = 0; i < scene_.colliders.size(); ++i) {
    const assets::Collider& c = scene_.colliders[i];
    if (!c.visible) continue;
    if (c.shape == assets::ColliderShape::kMesh) {
      const BodySurface& drawn = shapes.colliders[i]->drawn;
      DrawnSurface d = drawn_surface(drawn.surface, drawn.position_count, c.look, texture_path(scene_, c.look), true);
      DrawnCollider placed{renderer_.add_mesh(std::move(d.mesh), std::move(d.looks)), make_collider(c),
                           !c.motion.empty()};
      placed.collider.world_from_shape.setIdentity();  // its vertices are placed
      renderer_.set_transform(placed.mesh, to_glm(placed.collider.pose(0)));
      colliders_.push_back(std::move(placed));
      continue;
    }
    if (!ground_plane_ && is_level(c) && scene_.render.ground.show != assets::GroundMode::kOff) {
      ground_plane_ = &c;
      continue;
    }
    const bool plane = c.shape == assets::ColliderShape::kPlane;
    DrawnCollider d{renderer_.add_shape(shape_of(c, extent), plain_look(c.look, texture_path(scene_, c.look), plane)),
                    make_collider(c), !c.motion.empty()};
    renderer_.set_transform(d.mesh, to_glm(d.collider.pose(0)));
    if (plane) renderer_.set_casts_shadow(d.mesh, false);
    colliders_.push_back(std::move(d));
  }
}

void Stage::place_lights(const ClipExtent& extent) {
  const glm::vec3 centre = extent.bounds.empty() ? glm::vec3(0) : extent.bounds.centre();
  const float size = std::max(2 * extent.bounds.radius(), 1e-3f);
  for (const assets::Light& l : scene_.lights) {
    const float intensity = static_cast<float>(l.intensity);
    const glm::vec3 direction = glm::normalize(to_vec(l.direction));
    render::Light light;
    if (l.kind == assets::LightKind::kSun) {
      light = render::sun_light(-direction, static_cast<float>(l.angle), intensity);
    } else {
      const glm::vec3 position = l.position ? to_vec(*l.position) : centre + 3 * size * direction;
      const float distance = glm::length(position - centre);
      light =
          render::area_light(position, centre, l.radius ? static_cast<float>(*l.radius) : 0.1f * distance, intensity);
    }
    light.color = to_linear(l.color);
    light.casts_shadow = l.shadow;
    lights_.push_back(light);
  }
}

void Stage::place_ground(const ClipExtent& extent) {
  const assets::Render& r = scene_.render;
  const render::Stage standard = render::default_stage(extent.bounds, camera_, true);
  environment_ = standard.environment;
  environment_.sky *= static_cast<float>(r.sky);
  environment_.ground_light *= static_cast<float>(r.sky);
  environment_.background_top = to_linear(r.background.top);
  environment_.background_bottom = to_linear(r.background.bottom);
  environment_.exposure = static_cast<float>(std::exp2(r.exposure));
  render::Ground& ground = environment_.ground;
  const bool other_plane = std::any_of(scene_.colliders.begin(), scene_.colliders.end(), [](const auto& c) {
    return c.visible && c.shape == assets::ColliderShape::kPlane;
  });
  ground.visible = ground_plane_ || r.ground.show == assets::GroundMode::kOn ||
                   (r.ground.show == assets::GroundMode::kAuto && !other_plane);
  ground.look.color = to_linear(r.ground.color);
  ground.look.roughness = static_cast<float>(r.ground.roughness);
  if (ground_plane_) {
    ground.height = static_cast<float>(make_collider(*ground_plane_).world_from_shape.translation().y());
    if (ground_plane_->look.color) ground.look.color = to_linear(*ground_plane_->look.color);
  } else {
    ground.height =
        r.ground.height ? static_cast<float>(*r.ground.height) : (extent.bounds.empty() ? 0.0f : extent.bounds.low.y);
    // A flat field would lie in the ground, and one of the two win in each pixel.
    if (!r.ground.height && !fields_.empty()) ground.height -= 0.05f * extent.bounds.radius();
  }
}

render::Image Stage::draw(const CachedFrame& frame) {
  const sim::State& state = frame.state;
  for (const DrawnBody& body : bodies_) renderer_.set_positions(body.mesh, points_of(state.x, body.first, body.count));
  for (const DrawnNet& net : nets_) renderer_.set_positions(net.mesh, net.shape->positions(state.x, net.first));
  for (const DrawnCollider& c : colliders_)
    if (c.moves) renderer_.set_transform(c.mesh, to_glm(c.collider.pose(state.t)));
  for (size_t i = 0; i < fields_.size(); ++i) {
    const Eigen::VectorXd& value = frame.fields.at(i).value;
    renderer_.set_positions(fields_[i].mesh, fields_[i].surface.positions(value));
    renderer_.set_values(fields_[i].mesh, map_places(value, fields_[i].range));
  }
  render::Image picture = renderer_.render(camera_, lights_, environment_);
  if (!bars_.empty()) render::draw_color_bars(picture, bars_);
  return picture;
}

}  // namespace softreel::app
