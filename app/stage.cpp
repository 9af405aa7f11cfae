#include "app/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/convert.h"
#include "app/drawn_bodies.h"
#include "app/drawn_surface.h"
#include "app/placement.h"
#include "app/scene_camera.h"
#include "app/world.h"
#include "assets/scene_names.h"
#include "render/color_map.h"
#include "render/panorama.h"

namespace softreel::app {
namespace {

glm::vec3 to_vec(const sim::Vec3& v) { return to_glm(Eigen::Vector3d(v)); }

/// A plane that lies still and level is the ground; others are drawn as a large sheet.
bool is_level(const assets::Collider& c) {
  if (c.shape != assets::ColliderShape::kPlane || !c.motion.empty()) return false;
  const sim::Collider plane = make_collider(c);
  return plane.world_from_shape.linear().col(1).y() > 1 - 1e-9;
}

/// The nearest of 1, 2, 5 times a power of ten that is not larger.
double round_size(double size) {
  if (!(size > 0)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  return (size >= 5 * power ? 5 : size >= 2 * power ? 2 : 1) * power;
}

render::RenderOptions options_of(const assets::Render& r) {
  constexpr int kMostAuto =
      1024;  // far beyond what the eye tells apart; keeps an unreachable tolerance from running on
  render::RenderOptions options;
  options.width = r.size[0];
  options.height = r.size[1];
  options.samples = r.samples == 0 ? kMostAuto : r.samples;
  options.tolerance = r.samples == 0 ? r.tolerance : 0;
  options.seed = static_cast<std::uint32_t>(r.seed);
  return options;
}

/// The state at `time` between two frames: 0 `a`, 1 `b`. Only what is drawn.
CachedFrame between(const CachedFrame& a, const CachedFrame& b, double time) {
  CachedFrame frame = b;
  frame.state.t = (1 - time) * a.state.t + time * b.state.t;
  frame.state.x = (1 - time) * a.state.x + time * b.state.x;
  for (size_t i = 0; i < frame.fields.size(); ++i)
    frame.fields[i].value = (1 - time) * a.fields[i].value + time * b.fields[i].value;
  return frame;
}

}  // namespace

Stage::Stage(const assets::Scene& scene, const Shapes& shapes, const ClipExtent& extent)
    : scene_(scene), renderer_(options_of(scene.render)) {
  add_bodies(shapes, extent);
  find_followed(shapes);
  add_fields(shapes, extent);
  add_colliders(shapes, extent);
  camera_ = camera_of(scene_, extent, bars_);
  place_lights(extent);
  place_ground(extent);
}

void Stage::add_bodies(const Shapes& shapes, const ClipExtent& extent) {
  size_t number = 0;
  for_each_body(scene_, shapes, [&](const assets::Body& body, const BodySurface& drawn, int first, bool cloth) {
    const size_t n = number++;
    if (!body.visible) return;
    DrawnSurface d = drawn_surface(scene_, drawn.surface, drawn.position_count, body.look, body.transform, cloth);
    const bool figure = n < extent.figures.size() && extent.figures[n] != nullptr;
    if (figure) {
      const std::size_t map = render::color_map_index(assets::name_of(body.data->colormap));
      for (render::Look& look : d.looks) {
        look.color_map = map;
        look.shading = static_cast<float>(body.data->shading);
      }
    }
    DrawnBody b{
        renderer_.add_mesh(std::move(d.mesh), std::move(d.looks)), first, drawn.position_count, nullptr, {0, 1}};
    if (figure) {
      b.figure = extent.figures[n];
      b.range = color_range(body.data->range, body.data->colormap, extent.figure_ranges[n]);
      if (body.data->colorbar)
        bars_.push_back({render::color_map_index(assets::name_of(body.data->colormap)), b.range[0], b.range[1],
                         body.data->label.empty() ? figure_label(body.data->show) : body.data->label});
    }
    bodies_.push_back(std::move(b));
  });
  for_each_net(scene_, shapes, [&](const assets::SpringBody& body, const BallsAndRods& drawn, int first) {
    nets_.push_back({renderer_.add_mesh(drawn.mesh(), {plain_look(scene_, body.look, false)}), first, &drawn});
  });
}

void Stage::add_fields(const Shapes& shapes, const ClipExtent& extent) {
  for (size_t i = 0; i < scene_.fields.size(); ++i) {
    const assets::Field& field = scene_.fields[i];
    DrawnSurface d =
        drawn_surface(scene_, shapes.fields[i].drawn.surface, shapes.fields[i].drawn.position_count, {}, {}, true);
    const std::array<double, 2> range = color_range(field.range, field.colormap, extent.field_ranges.at(i));
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
      DrawnSurface d = drawn_surface(scene_, drawn.surface, drawn.position_count, c.look, c.transform, true);
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
    render::Shape shape = shape_of(c, std::max(6.0f * extent.bounds.radius(), 1.0f));
    for (const std::uint32_t position : shape.mesh.position_of) shape.mesh.rest.push_back(shape.positions[position]);
    DrawnCollider d{renderer_.add_shape(std::move(shape), plain_look(scene_, c.look, plane)), make_collider(c),
                    !c.motion.empty()};
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
      const float side = 0.2f * distance;
      if (l.kind == assets::LightKind::kRectangle)
        light = render::rectangle_light(
            position, centre,
            l.size ? glm::vec2(static_cast<float>((*l.size)[0]), static_cast<float>((*l.size)[1])) : glm::vec2(side),
            intensity);
      else
        light = render::area_light(position, centre, l.radius ? static_cast<float>(*l.radius) : 0.5f * side, intensity);
    }
    // One that nobody has placed is as far away as it has to be to light the ground evenly.
    if (!l.position) light.reference_distance = 0;
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
  environment_.sky_shadow = r.sky_shadow;
  if (!r.sky_map.empty()) {
    const render::HdrImage sky = render::load_hdr(scene_.asset_path(r.sky_map));
    environment_.panorama =
        std::make_shared<render::Panorama>(sky, static_cast<float>(r.sky), static_cast<float>(r.sky_turn));
    environment_.panorama_behind = r.background.sky;
    if (sky.mended > 0)
      notes_.push_back(
          fmt::format("{}: {} of {} pixels are negative, no finite numbers or brighter than 1e6; these "
                      "count as black or as 1e6",
                      r.sky_map, sky.mended, sky.pixels.size()));
  }
  environment_.transparent = r.background.transparent;
  environment_.background_top = to_linear(r.background.top);
  environment_.background_bottom = to_linear(r.background.bottom);
  environment_.exposure = static_cast<float>(std::exp2(r.exposure));
  render::Ground& ground = environment_.ground;
  const bool other_plane = std::any_of(scene_.colliders.begin(), scene_.colliders.end(), [](const auto& c) {
    return c.visible && c.shape == assets::ColliderShape::kPlane;
  });
  ground.catches_shadow = r.ground.show == assets::GroundMode::kShadow;
  ground.visible = ground_plane_ || r.ground.show == assets::GroundMode::kOn || ground.catches_shadow ||
                   (r.ground.show == assets::GroundMode::kAuto && !other_plane);
  ground.look.color = to_linear(r.ground.color);
  ground.look.roughness = static_cast<float>(r.ground.roughness);
  ground.look.pattern = static_cast<render::Pattern>(r.ground.pattern);
  ground.look.pattern_color = to_linear(r.ground.pattern_color);
  ground.look.pattern_size =
      static_cast<float>(r.ground.pattern_size.value_or(round_size(0.2 * extent.bounds.radius())));
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

render::FloatImage Stage::draw_linear(const CachedFrame& frame) {
  move_to(frame);
  return renderer_.render_linear(camera_now(frame), lights_, environment_);
}

render::Image Stage::draw_from(const CachedFrame& frame, const render::Camera& camera) {
  move_to(frame);
  render::Image picture = renderer_.render(camera, lights_, environment_);
  if (!bars_.empty()) render::draw_color_bars(picture, bars_);
  return picture;
}

void Stage::find_followed(const Shapes& shapes) {
  if (scene_.camera.follow.empty()) return;
  int first = 0;
  const auto look_for = [&](const auto& bodies, const auto& of, const auto& points_of_shape) {
    for (size_t i = 0; i < bodies.size(); ++i) {
      const std::vector<sim::Vec3>& points = points_of_shape(of[i]);
      if (bodies[i].name == scene_.camera.follow) {
        followed_first_ = first;
        followed_count_ = static_cast<int>(points.size());
        for (const sim::Vec3& p : points) followed_start_ += to_vec(p) / static_cast<float>(followed_count_);
      }
      first += static_cast<int>(points.size());
    }
  };
  const auto vertices = [](const auto& shape) -> const std::vector<sim::Vec3>& { return shape.rest.vertices; };
  look_for(scene_.soft, shapes.soft, vertices);
  look_for(scene_.cloth, shapes.cloth, vertices);
  look_for(scene_.springs, shapes.springs,
           [](const auto& shape) -> const std::vector<sim::Vec3>& { return shape.rest; });
}

render::Camera Stage::camera_now(const CachedFrame& frame) const {
  glm::vec3 moved(0);
  if (followed_count_ > 0) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int i = 0; i < followed_count_; ++i) mean += frame.state.x.segment<3>(3 * (followed_first_ + i));
    moved = to_glm(Eigen::Vector3d(mean / followed_count_)) - followed_start_;
  }
  return camera_at(scene_.camera, camera_, frame.state.t, moved);
}

render::Channels Stage::channels() { return renderer_.render_channels(last_camera_, environment_); }

void Stage::move_to(const CachedFrame& frame) {
  const sim::State& state = frame.state;
  for (const DrawnBody& body : bodies_) {
    renderer_.set_positions(body.mesh, points_of(state.x, body.first, body.count));
    if (body.figure)
      renderer_.set_values(body.mesh, map_places(body.figure->values(frame).head(body.count), body.range));
  }
  for (const DrawnNet& net : nets_) renderer_.set_positions(net.mesh, net.shape->positions(state.x, net.first));
  for (const DrawnCollider& c : colliders_)
    if (c.moves) renderer_.set_transform(c.mesh, to_glm(c.collider.pose(state.t)));
  for (size_t i = 0; i < fields_.size(); ++i) {
    const Eigen::VectorXd& value = frame.fields.at(i).value;
    renderer_.set_positions(fields_[i].mesh, fields_[i].surface.positions(value));
    renderer_.set_values(fields_[i].mesh, map_places(value, fields_[i].range));
  }
}

render::Image Stage::draw(int number, const CachedFrame& frame, const CachedFrame* before) {
  if (scene_.render.animate_seed)
    renderer_.set_seed(static_cast<std::uint32_t>(scene_.render.seed) + static_cast<std::uint32_t>(number));
  render::Shutter shutter;
  const double open = scene_.render.shutter;
  if (open > 0 && before)
    shutter = [&](float time) {
      const CachedFrame now = between(*before, frame, 1 - open * (1 - static_cast<double>(time)));
      move_to(now);
      return camera_now(now);
    };
  else
    move_to(frame);
  last_camera_ = camera_now(frame);
  render::Image picture = renderer_.render(last_camera_, lights_, environment_, shutter);
  if (!bars_.empty()) render::draw_color_bars(picture, bars_);
  return picture;
}

}  // namespace softreel::app
