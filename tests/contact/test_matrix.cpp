// The matrix of an implicit step with contact between surfaces, against the sum of all stencils made dense.
#include <doctest/doctest.h>

#include "sim/term_list.h"
#include "tests/contact/scenes.h"
#include "tests/sim/linear_systems.h"

using namespace softreel;
using namespace softreel::sim;
using namespace softreel::tests;

namespace {

/// scale * Hessian of a term at q, by its stencils one after the other; rows and columns of `held` stay zero.
Eigen::MatrixXd naive_hessian(const EnergyTerm& term, const Eigen::VectorXd& q, double scale, Definiteness definiteness,
                              const std::vector<std::uint8_t>& held) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(q.size(), q.size());
  if (term.changing_stencils()) term.select(q);
  const int k = term.stencil_size(), count = stencil_count(term);
  std::vector<double> blocks(static_cast<size_t>(count * hessian_doubles(k)));
  if (count > 0) term.element_hessians(q, scale, definiteness, {0, count}, blocks.data());
  const double* next = blocks.data();
  for (int e = 0; e < count; ++e)
    for (int a = 0; a < k; ++a)
      for (int b = a; b < k; ++b, next += 9) {
        const int i = term.stencils()[static_cast<size_t>(e * k + a)],
                  j = term.stencils()[static_cast<size_t>(e * k + b)];
        if (i < 0 || j < 0) continue;
        const Eigen::Map<const Eigen::Matrix3d> block(next);
        H.block<3, 3>(3 * i, 3 * j) += block;
        if (a != b) H.block<3, 3>(3 * j, 3 * i) += block.transpose();
      }
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (held[static_cast<size_t>(i)]) H.row(i).setZero(), H.col(i).setZero();
  return H;
}

}  // namespace

TEST_CASE("the matrix of a step is the sum of its terms, also where what changes grows, shrinks and hardens") {
  TouchingScene scene;
  const MembraneMaterial cotton{"stvk", 1e4, 0.3, 1e-3, 1e-3, BendingModel::kAuto, 0.2};
  const double gap = 1e-3;
  scene.add_cloth("upper", moved(grid_sheet(0.4, 0.4, 4, 4), Vec3(0.01, 3 * gap, 0.013), Vec3(0, 10, 0)), cotton, 0.3,
                  false);
  const BodyRange lower =
      scene.add_cloth("lower", moved(grid_sheet(0.5, 0.5, 5, 5), Vec3(0, 2 * gap, 0)), cotton, 0.3, true);
  scene.add_mesh_collider("table", moved(grid_sheet(1, 1, 3, 3), Vec3(0.02, gap, 0.01)), 0.3);
  Collider ground;
  ground.friction = 0.5;
  ground.world_from_shape.translation() = Vec3(0, 0.5 * gap, 0);
  scene.colliders.push_back(ground);
  Pin pin;
  pin.vertices = {lower.first, lower.first + 7};
  scene.builder.add_pin(std::move(pin));
  Simulation simulation = scene.start();
  const Model& model = simulation.model();

  const double h = 1.0 / 60;
  const Eigen::VectorXd &x = simulation.state().x, v = Eigen::VectorXd::Zero(x.size());
  const TermList terms = terms_of(model, {});
  const auto begin = [&](double t) {
    for (const auto* list : {&terms.potentials, &terms.dissipations})
      for (EnergyTerm* term : *list) term->begin_step({x, v, x, t, h, h, t + h, 1});
  };
  begin(1);
  const Pins pins(model);
  IncrementalPotential phi(model, pins, terms);
  Stage& stage = phi.stage();
  stage.y_tilde = x;
  stage.beta = h * h;
  stage.a = 1 / h;
  stage.b = -stage.a * x;

  StepReport report;
  BlockMatrix H;
  const auto naive = [&](const Eigen::VectorXd& y, Definiteness definiteness) {
    const auto& held = phi.held();
    const Eigen::VectorXd velocity = stage.a * y + stage.b;
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(y.size(), y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i)
      sum(i, i) = held[static_cast<size_t>(i)] ? 1 : stage.inertia * model.masses(i / 3);
    for (const EnergyTerm* term : terms.potentials) sum += naive_hessian(*term, y, stage.beta, definiteness, held);
    for (const EnergyTerm* term : terms.dissipations)
      sum += naive_hessian(*term, velocity, stage.beta * stage.a, definiteness, held);
    return sum;
  };
  const auto agrees = [&](const Eigen::VectorXd& y, Definiteness definiteness) {
    const Eigen::MatrixXd sum = naive(y, definiteness);
    CHECK((dense(H) - sum).norm() < 1e-12 * sum.norm());
  };
  const auto displaced = [&](const Vec3& by, double random) {
    Eigen::VectorXd y = x;
    std::srand(3);
    y += random * Eigen::VectorXd::Random(y.size());
    for (Eigen::Index i = 0; i < y.size(); i += 3) y.segment<3>(i) += i < 3 * lower.first ? by : Vec3(Vec3::Zero());
    return y;
  };

  phi.begin();
  std::vector<size_t> blocks;
  for (const Eigen::VectorXd& y :
       {displaced(Vec3(0, 0.01, 0), 0), x, displaced(Vec3(0.02, -1e-4, 0.01), 1e-4), displaced(Vec3(0, 0.01, 0), 0)}) {
    for (const Definiteness definiteness : {Definiteness::kExact, Definiteness::kClamped}) {
      phi.hessian(y, definiteness, H, report);
      agrees(y, definiteness);
    }
    blocks.push_back(H.column.size());
  }
  CHECK(blocks[2] > blocks[0]);   // what is new gets a place
  CHECK(blocks[3] == blocks[2]);  // and keeps it for the solve
  phi.begin();
  phi.hessian(displaced(Vec3(0, 0.01, 0), 0), Definiteness::kExact, H, report);
  CHECK(H.column.size() == blocks[0]);

  // Sliding that a step turns around; whoever is held has no part in it.
  const Eigen::VectorXd y = displaced(Vec3(2e-4, 0, 0), 3e-5), back = displaced(Vec3(-2e-4, 0, 0), -3e-5);
  phi.hessian(y, Definiteness::kClamped, H, report);
  const Eigen::MatrixXd before = naive(y, Definiteness::kClamped);
  REQUIRE(phi.harden(y, back - y, Definiteness::kClamped, H, report));
  const Eigen::MatrixXd after = naive(y, Definiteness::kClamped);
  CHECK((after - before).norm() > 1e-3 * before.norm());
  CHECK((dense(H) - after).norm() < 1e-12 * after.norm());
  CHECK_FALSE(phi.harden(y, back - y, Definiteness::kClamped, H, report));
  CHECK((dense(H) - after).norm() < 1e-12 * after.norm());
}
