#pragma once
// Scenes of surfaces that touch, and what is watched in all of them: nothing crosses in any accepted step.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "assets/crossing_pairs.h"
#include "sim/contact/surface_contact.h"
#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

namespace softreel::tests {

using sim::Vec3;

inline const Vec3 kGravity(0, -9.81, 0);

/// Bodies and mesh colliders that touch each other; `self` where it is asked for.
class TouchingScene {
 public:
  sim::ContactSettings contact;
  sim::SimulationSettings settings;
  Vec3 gravity = kGravity;
  sim::Damping damping;
  std::vector<sim::Collider> colliders;
  sim::ModelBuilder builder;

  sim::BodyRange add_cloth(const std::string& name, const sim::TriangleMesh& mesh, const sim::MembraneMaterial& m,
                           double friction, bool self) {
    const sim::BodyRange body = builder.add_membrane(name, mesh, m);
    surfaces.push_back({name, body.first, mesh.vertices, mesh.triangles, {}, 0, friction, self, true});
    return body;
  }
  sim::BodyRange add_solid(const std::string& name, const sim::TetMesh& mesh, const sim::SolidMaterial& m,
                           double friction, bool self = false) {
    const sim::BodyRange body = builder.add_solid(name, mesh, m);
    surfaces.push_back({name, body.first, mesh.vertices, sim::boundary_triangles(mesh), {}, 0, friction, self, true});
    return body;
  }
  void add_mesh_collider(const std::string& name, const sim::TriangleMesh& mesh, double friction,
                         sim::Motion motion = {}) {
    surfaces.push_back({name, -1, mesh.vertices, mesh.triangles, std::move(motion), 0, friction, false, true});
  }

  sim::Simulation start() {
    builder.set_surfaces(surfaces, rules);
    return sim::Simulation(builder.finish(gravity, damping, colliders, contact), settings);
  }

  std::vector<sim::SurfaceInput> surfaces;
  std::vector<sim::SurfacePairRule> rules;
};

/// Pairs of triangles that cross in the simulation's present state.
inline size_t crossing_count(const sim::Simulation& s) {
  const sim::ContactSurfaces& surfaces = s.model().surfaces->surfaces();
  std::vector<Vec3> x;
  surfaces.gather(s.state().x, surfaces.collider_path(s.state().t, s.state().t), 0, x);
  return assets::crossing_pairs({x, surfaces.triangles}, 100).size();
}

/// Steps and looks: each one converges, and nothing crosses. Returns what they took.
inline sim::StepReport run_without_crossing(sim::Simulation& s, double h, int steps) {
  sim::StepReport total;
  for (int i = 0; i < steps; ++i) {
    const sim::StepReport r = s.step(h);
    REQUIRE_MESSAGE(r.converged, "step ", i + 1, ": ", r.reason);
    total.add(r);
    REQUIRE(crossing_count(s) == 0);
  }
  return total;
}

inline sim::TetMesh moved(sim::TetMesh mesh, const Vec3& by, const Vec3& degrees = Vec3::Zero()) {
  const Eigen::Matrix3d R = sim::euler_xyz(degrees);
  for (Vec3& v : mesh.vertices) v = R * v + by;
  return mesh;
}

inline sim::TriangleMesh moved(sim::TriangleMesh mesh, const Vec3& by, const Vec3& degrees = Vec3::Zero()) {
  const Eigen::Matrix3d R = sim::euler_xyz(degrees);
  for (Vec3& v : mesh.vertices) v = R * v + by;
  return mesh;
}

/// A ball of tetrahedra: a block whose layers are blown up to spheres.
inline sim::TetMesh ball_of_tets(double radius, int cells) {
  sim::TetMesh mesh = sim::block_of_tets(Vec3::Constant(2), cells, cells, cells);
  for (Vec3& v : mesh.vertices) {
    const double layer = v.cwiseAbs().maxCoeff(), length = v.norm();
    if (length > 0) v *= radius * layer / length;
  }
  return mesh;
}

/// A ring around the y axis, as a closed surface: distance from the axis to the middle of its tube, radius of that.
inline sim::TriangleMesh ring(double radius, double tube, int around = 24, int across = 12) {
  sim::TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double r = radius + tube * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), tube * std::sin(b), r * std::sin(a));
      const int i1 = (i + 1) % around, j1 = (j + 1) % across;
      const auto at = [&](int p, int q) { return p * across + q; };
      mesh.triangles.push_back({at(i, j), at(i, j1), at(i1, j)});
      mesh.triangles.push_back({at(i1, j), at(i, j1), at(i1, j1)});
    }
  return mesh;
}

inline double mechanical_energy(const sim::Simulation& s) {
  const sim::Energies e = s.energies();
  return e.kinetic + e.elastic + e.gravity + e.contact;
}

}  // namespace softreel::tests
