#pragma once
// Small scenes without impacts, in SI units, for what is promised about the error of a clip.
#include <functional>
#include <string>
#include <vector>

#include "sim/grids.h"
#include "tests/sim/support.h"

namespace softreel::tests {

struct AdaptiveScene {
  const char* name;
  std::function<sim::Model()> make;
  double fps = 24;     // [1/s]
  int intervals = 36;  // between frames
  double target = 0;   // RMS over the vertices [m]
  std::vector<std::string> integrators;
};

/// Points in a row, the first one held, joined by springs at rest.
inline sim::Model row_of_points(int links, const sim::Vec3& way, double mass, double stiffness, double damping,
                                const sim::Vec3& gravity, const sim::Damping& all = {}) {
  std::vector<sim::Vec3> points;
  std::vector<sim::Spring> springs;
  for (int i = 0; i <= links; ++i) points.push_back(way * (double(i) / links));
  for (int i = 0; i < links; ++i) springs.push_back({i, i + 1, stiffness, (points[1] - points[0]).norm()});
  sim::ModelBuilder builder;
  builder.add_points("row", points, std::vector<double>(points.size(), mass), springs, damping);
  sim::Pin pin;
  pin.vertices = {0};
  builder.add_pin(pin);
  return builder.finish(gravity, all, {}, {});
}

inline sim::Model stretched_oscillator(double damping) {
  sim::Model model = row_of_points(1, sim::Vec3(0, -1, 0), 0.5, 40, damping, sim::Vec3::Zero());
  model.x0(4) = -1.2;
  return model;
}

inline sim::Model sheet_of_springs() {
  const sim::TriangleMesh sheet = sim::grid_sheet(0.6, 0.6, 5, 5);
  sim::ModelBuilder builder;
  builder.add_mass_spring("sheet", sheet, sim::grid_springs(sheet, 5, 5, {40, 20, 4}), 0.3, 0.01);
  builder.add_pin(
      pin_where(sheet.vertices, [](const sim::Vec3& p) { return p.x() < -0.29 && std::abs(p.z()) > 0.29; }));
  return builder.finish(sim::Vec3(0, -9.81, 0), {0.5, 0, 0}, {}, {});
}

inline sim::Model hanging_cloth() {
  const sim::TriangleMesh sheet = sim::grid_sheet(0.6, 0.6, 5, 5);
  sim::ModelBuilder builder;
  builder.add_membrane("cloth", sheet, {"stvk", 2e3, 0.3, 1e-2, 1e-3, sim::BendingModel::kAuto, 0.5});
  builder.add_pin(pin_where(sheet.vertices, [](const sim::Vec3& p) { return p.x() < -0.29; }));
  return builder.finish(sim::Vec3(0, -9.81, 0), {1.0, 0, 0}, {}, {});
}

inline sim::Model cantilever() {
  const sim::TetMesh bar = sim::block_of_tets(sim::Vec3(0.5, 0.1, 0.1), 8, 2, 2);
  sim::ModelBuilder builder;
  builder.add_solid("bar", bar, {"stable-neo-hookean", 2e5, 0.3, 1000});
  builder.add_pin(pin_where(bar.vertices, [](const sim::Vec3& p) { return p.x() < -0.249; }));
  return builder.finish(sim::Vec3(0, -9.81, 0), {}, {}, {});
}

inline sim::Model rotating_body() {
  const sim::TetMesh block = sim::block_of_tets(sim::Vec3(0.4, 0.2, 0.1), 3, 2, 1);
  sim::ModelBuilder builder;
  const sim::BodyRange range = builder.add_solid("block", block, {"stable-neo-hookean", 1e4, 0.3, 1000});
  builder.set_velocity(range, sim::Vec3(0.5, 2, 0), sim::Vec3(0.3, 4, 0.2));
  return builder.finish(sim::Vec3(0, -9.81, 0), {}, {}, {});
}

inline std::vector<AdaptiveScene> adaptive_scenes() {
  using sim::Vec3;
  const Vec3 g(0, -9.81, 0);
  const auto oscillator = [] { return stretched_oscillator(0); };
  const auto damped = [] { return stretched_oscillator(0.8); };
  return {
      {"linear oscillator", oscillator, 24, 36, 2e-4, {"newmark", "verlet"}},
      {"linear oscillator", oscillator, 24, 36, 2e-3, {"implicit-euler", "symplectic-euler"}},
      {"damped spring", damped, 24, 36, 1e-4, {"bdf2", "heun"}},
      {"damped spring", damped, 24, 36, 1e-3, {"implicit-euler"}},
      {"spring pendulum",
       [g] { return row_of_points(1, Vec3(0.8, -0.2, 0), 0.5, 60, 0, g); },
       24,
       36,
       1e-4,
       {"leapfrog", "implicit-midpoint"}},
      {"chain of pendulums",
       [g] { return row_of_points(4, Vec3(0.8, 0, 0), 0.1, 400, 0, g); },
       24,
       24,
       1e-4,
       {"verlet", "newmark", "rk4"}},
      {"sheet of springs", sheet_of_springs, 24, 24, 1e-4, {"verlet", "newmark"}},
      {"hanging cloth", hanging_cloth, 24, 24, 2e-4, {"newmark", "bdf2"}},
      {"cantilever", cantilever, 24, 12, 5e-5, {"newmark", "implicit-midpoint"}},
      {"rotating free body", rotating_body, 24, 18, 5e-5, {"newmark", "implicit-midpoint"}},
  };
}

}  // namespace softreel::tests
