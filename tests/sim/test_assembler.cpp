// The assembled matrix against the sum of its elements made dense, and terms that count for nothing.
#include <doctest/doctest.h>

#include "sim/grids.h"
#include "sim/hessian_assembler.h"
#include "sim/mesh_topology.h"
#include "tests/sim/linear_systems.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

/// A block and a sheet: solid, membrane, and bending, whose Hessian is constant.
Model block_and_sheet() {
  ModelBuilder builder;
  builder.add_solid("block", block_of_tets(Vec3(1, 1, 1), 4, 4, 4), {"stable-neo-hookean", 1e5, 0.4, 1000});
  builder.add_membrane("sheet", grid_sheet(1, 1, 8, 8), {"stvk", 1e4, 0.3, 1e-3, 1e-2, BendingModel::kAuto, 0.2});
  return builder.finish(Vec3(0, -9.81, 0), {}, {}, {});
}

}  // namespace

TEST_CASE("many parts add up to the naive sum, with scales that change from step to step and are zero in between") {
  const Model model = block_and_sheet();
  std::vector<const EnergyTerm*> terms;
  for (const auto& term : model.potentials) terms.push_back(term.get());
  bool constant = false;
  for (const EnergyTerm* term : terms) constant = constant || term->constant_hessian();
  REQUIRE(constant);
  HessianAssembler assembler(model.vertices(), terms);  // 512 stencils and more: several parts
  const std::vector<std::uint8_t> free(static_cast<size_t>(model.x0.size()), 0);
  const Eigen::VectorXd x = model.x0 + random_vector(model.x0.size(), 0.01, 7);
  BlockMatrix A;
  for (const double scale : {1.0, 0.25, 0.0, 1.0}) {
    CAPTURE(scale);
    std::vector<ScaledTerm> scaled;
    Eigen::MatrixXd naive = Eigen::MatrixXd::Zero(x.size(), x.size());
    for (int i = 0; i < model.vertices(); ++i) naive.diagonal().segment<3>(3 * i).array() += model.masses(i);
    for (const EnergyTerm* term : terms) {
      scaled.push_back({term, &x, scale});
      if (term->stencil_size() > 0) naive += scale * dense_hessian(*term, x, Definiteness::kExact);
    }
    const long before = assembler.evaluations();
    assembler.assemble(scaled, model.masses, free, Definiteness::kExact, A);
    CHECK((dense(A) - naive).norm() < 1e-13 * naive.norm());
    if (scale == 0) CHECK(assembler.evaluations() == before);
  }
}

TEST_CASE("what acts by velocity alone is not asked where there is none: equilibria with friction, wind and damping") {
  ModelBuilder builder;
  const TriangleMesh sheet = grid_sheet(1, 1, 8, 8);
  builder.add_membrane("sheet", sheet, {"stvk", 1e4, 0.3, 1e-3, 1e-3, BendingModel::kAuto, 0.2});
  builder.add_pin(pin_where(sheet.vertices, [](const Vec3& p) { return p.x() < -0.49; }));
  Collider plane;
  plane.world_from_shape.translation() = Vec3(0, -0.3, 0);
  plane.friction = 0.5;
  Wind wind;
  wind.velocity = Vec3(0, 0, 3);
  builder.set_wind(wind, {{sheet.triangles, false}});
  ContactSettings contact;
  contact.stiffness = 1e4;
  SimulationSettings settings;
  settings.integrator = "static";
  settings.minimizer.max_iterations = 300;
  settings.load_time = 1;
  Simulation s(builder.finish(Vec3(0, -9.81, 0), {0.1, 0, 1e-3}, {plane}, contact), settings);
  must_step(s, 0.25, 6);
  CHECK(s.state().x.allFinite());
}

TEST_CASE("a run that is resumed with wind, friction and damping of springs goes on with the same bits") {
  const auto make = [] {
    ModelBuilder builder;
    TriangleMesh sheet = grid_sheet(1, 1, 8, 8);
    for (Vec3& v : sheet.vertices) v.y() += 0.02;
    std::vector<Spring> springs;
    for (const auto& [a, b] : edges(sheet))
      springs.push_back(
          {a, b, 100, (sheet.vertices[static_cast<size_t>(a)] - sheet.vertices[static_cast<size_t>(b)]).norm()});
    builder.add_mass_spring("sheet", sheet, springs, 0.2, 0.01);
    Collider plane;
    plane.friction = 0.5;
    Wind wind;
    wind.velocity = Vec3(3, 0, 1);
    builder.set_wind(wind, {{sheet.triangles, false}});
    return Simulation(builder.finish(Vec3(0, -9.81, 0), {0.1, 0, 1e-3}, {plane}, {}), {});
  };
  Simulation whole = make(), resumed = make();
  must_step(whole, 1.0 / 60, 8);
  resumed.restore(whole.state(), whole.memory());
  must_step(whole, 1.0 / 60, 8);
  must_step(resumed, 1.0 / 60, 8);
  CHECK(resumed.state().x == whole.state().x);
}
