#include "app/forecast_meetings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/world.h"

namespace softreel::app {
namespace {

using sim::Vec3;
using Box = Eigen::AlignedBox3d;

double clip_seconds(const assets::Scene& scene) { return (scene.time.frames() - 1) / scene.time.fps; }

/// The fastest that any of the points (at rest) is driven [m/s].
double driven_speed(const sim::Motion& motion, const std::vector<assets::MotionKey>& keys,
                    const std::vector<Vec3>& points) {
  double fastest = 0;
  for (size_t k = 1; k < keys.size(); ++k)
    for (const Vec3& p : points) fastest = std::max(fastest, motion.velocity(keys[k].t, p).norm());
  return fastest;
}

bool attached(const assets::Scene& scene, const std::string& place) {
  return std::any_of(scene.attachments.begin(), scene.attachments.end(),
                     [&](const assets::Attach& a) { return a.bodies[0].place == place || a.bodies[1].place == place; });
}

/// Half the extent of a collider in its own frame [m]; of a plane none.
Vec3 half_extent(const assets::Collider& c) {
  const double scale = c.transform.scale.x();
  switch (c.shape) {
    case assets::ColliderShape::kPlane:
    case assets::ColliderShape::kMesh:  // stopped by continuous collision detection, at any speed
      return Vec3::Zero();
    case assets::ColliderShape::kSphere:
      return Vec3::Constant(c.radius * scale);
    case assets::ColliderShape::kCapsule:
      return scale * Vec3(c.radius, c.radius + 0.5 * c.height, c.radius);
    case assets::ColliderShape::kBox:
      return 0.5 * c.transform.scale.cwiseProduct(c.size);
  }
  return Vec3::Zero();
}

std::vector<Vec3> corners_of(const sim::Collider& placed, const Vec3& half) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(placed.world_from_shape *
                      Vec3((k & 1 ? 1 : -1) * half.x(), (k & 2 ? 1 : -1) * half.y(), (k & 4 ? 1 : -1) * half.z()));
  return corners;
}

/// Where a body may come to, and how fast it may be there by itself.
struct Reach {
  Box box;
  double speed = 0;  // [m/s]
};

Reach reach_of(const assets::Scene& scene, const MovingBody& m, double lowest) {
  Box own;
  for (const Vec3& p : *m.rest) own.extend(p);
  const double size = own.diagonal().norm(), seconds = clip_seconds(scene), g = scene.gravity.norm();
  Reach reach{own, m.body->velocity.norm() + m.body->spin.norm() * std::numbers::pi / 180 * size / 2};
  for (double speed : m.pin_speeds) reach.speed = std::max(reach.speed, speed);
  if (m.held) {
    reach.box.min().array() -= size / 2;
    reach.box.max().array() += size / 2;
    for (const assets::Pin& pin : m.body->pins)
      for (const assets::MotionKey& key : pin.motion) reach.box.extend(own.translated(key.translate));
    return reach;
  }
  const Box flown = own.translated(seconds * m.body->velocity);
  reach.box.extend(flown);
  if (!(g > 0)) return reach;
  const Vec3 down = scene.gravity / g;
  double top = lowest;
  for (const Vec3& p : *m.rest) top = std::min(top, down.dot(p));
  const double drop = std::min(lowest - top, 0.5 * g * seconds * seconds);
  reach.box.extend(own.translated(drop * down));
  reach.box.extend(flown.translated(drop * down));
  reach.speed = std::hypot(reach.speed, std::sqrt(2 * g * drop));
  return reach;
}

bool meet(const assets::Scene& scene, const Reach& reach, const assets::Collider& c, const sim::Collider& placed) {
  const double near = scene.contact.distance;
  if (c.shape == assets::ColliderShape::kPlane) {
    const auto inside = [&](const Vec3& p) {
      return sim::signed_distance(placed.shape, placed.world_from_shape.inverse() * p).distance < near;
    };
    for (int k = 0; k < 8; ++k)
      if (inside(reach.box.corner(static_cast<Box::CornerType>(k)))) return true;
    return !c.motion.empty();
  }
  Box box;
  for (const Vec3& p : corners_of(placed, half_extent(c))) {
    box.extend(p);
    for (const assets::MotionKey& key : c.motion) box.extend(placed.motion.pose(key.t) * p);
  }
  box.min().array() -= near;
  box.max().array() += near;
  return box.intersects(reach.box);
}

/// Whether the collider stands where pins hold the body.
bool holds(const MovingBody& m, const std::vector<int>& pinned, const sim::Model& model, const sim::Collider& placed) {
  return std::any_of(pinned.begin(), pinned.end(), [&](int v) {
    const Vec3 p = placed.world_from_shape.inverse() * Vec3(model.x0.segment<3>(3 * v));
    return sim::signed_distance(placed.shape, p).distance < m.edges.longest;
  });
}

/// Whether the body's pins and the collider are driven alike.
bool same_motion(const assets::Body& body, const assets::Collider& c) {
  const auto same = [](const assets::MotionKey& a, const assets::MotionKey& b) {
    return a.t == b.t && a.translate == b.translate && a.rotate == b.rotate;
  };
  return std::any_of(body.pins.begin(), body.pins.end(), [&](const assets::Pin& pin) {
    return std::equal(pin.motion.begin(), pin.motion.end(), c.motion.begin(), c.motion.end(), same);
  });
}

}  // namespace

std::vector<MovingBody> moving_bodies(const assets::Scene& scene, const Shapes& shapes, const sim::Model& model) {
  std::vector<MovingBody> bodies;
  size_t next = 0;  // in model.pins, which follow the bodies
  const auto add = [&](const assets::Body& body, const std::vector<Vec3>& rest, const Edges& edges, const char* kind,
                       size_t i) {
    MovingBody m{&body, &rest, edges, {}, !body.pins.empty() || attached(scene, kind + std::to_string(i + 1))};
    for (const assets::Pin& description : body.pins) {
      const sim::Pin& pin = model.pins[next++];
      std::vector<Vec3> points;
      for (int v : pin.vertices) points.push_back(model.x0.segment<3>(3 * v));
      m.pin_speeds.push_back(driven_speed(pin.motion, description.motion, points));
    }
    bodies.push_back(std::move(m));
  };
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    const sim::TetMesh& mesh = shapes.soft[i].rest;
    add(scene.soft[i], mesh.vertices, edges_of(mesh.vertices, mesh.tets), "soft.", i);
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i) {
    const sim::TriangleMesh& mesh = shapes.cloth[i].rest;
    add(scene.cloth[i], mesh.vertices, edges_of(mesh.vertices, mesh.triangles), "cloth.", i);
  }
  for (size_t i = 0; i < scene.springs.size(); ++i) {
    const SpringShape& shape = shapes.springs[i];
    add(scene.springs[i], shape.rest, edges_of(shape.rest, shape.edges), "springs.", i);
  }
  return bodies;
}

std::vector<Meeting> meetings_of(const assets::Scene& scene, const std::vector<MovingBody>& bodies,
                                 const sim::Model& model) {
  std::vector<Meeting> meetings;
  if (scene.colliders.empty() || bodies.empty()) return meetings;
  const Vec3 down = scene.gravity.normalized();
  double lowest = down.dot(bodies[0].rest->front());  // of all there is, along gravity
  for (const MovingBody& m : bodies)
    for (const Vec3& p : *m.rest) lowest = std::max(lowest, down.dot(p));
  for (const assets::Collider& c : scene.colliders) lowest = std::max(lowest, down.dot(c.transform.translate));
  for (const assets::Collider& c : scene.colliders) {
    const sim::Collider placed = make_collider(c);
    const double own = driven_speed(placed.motion, c.motion, corners_of(placed, half_extent(c)));
    size_t next = 0;
    for (const MovingBody& m : bodies) {
      std::vector<int> pinned;
      for (size_t p = 0; p < m.body->pins.size(); ++p, ++next)
        pinned.insert(pinned.end(), model.pins[next].vertices.begin(), model.pins[next].vertices.end());
      const Reach reach = reach_of(scene, m, lowest);
      if (holds(m, pinned, model, placed) || !meet(scene, reach, c, placed)) continue;
      meetings.push_back({&m, &c, reach.speed + (same_motion(*m.body, c) ? 0 : own)});
    }
  }
  return meetings;
}

double inner_radius(const assets::Collider& c) {
  return c.shape == assets::ColliderShape::kPlane ? 0 : half_extent(c).minCoeff();
}

}  // namespace softreel::app
