// The fastest mode of a scene, and that the steps which follow from it are the ones that hold.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "sim/grids.h"
#include "sim/lanczos.h"
#include "sim/linearization.h"
#include "sim/stability.h"
#include "sim/step_limit.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

/// Column by column through the products alone: nothing of the iteration is in it.
Eigen::MatrixXd matrix_of(Eigen::Index size, const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& f) {
  Eigen::MatrixXd A(size, size);
  Eigen::VectorXd column(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    f(Eigen::VectorXd::Unit(size, k), column);
    A.col(k) = column;
  }
  return A;
}

struct Scene {
  std::string material = "stable-neo-hookean";
  bool consistent = false;
  double beta = 0, drag = 0;
  bool ground = false;
  std::string integrator = "symplectic-euler";
};

/// A block of 2 x 2 x 2 cells, held at one side, beside a stiffer sheet with bending.
Model block_and_sheet(const Scene& s) {
  ModelBuilder builder;
  const TetMesh block = block_of_tets(Vec3(0.2, 0.2, 0.2), 2, 2, 2);
  const BodyRange range = builder.add_solid("block", block, {s.material, 1e4, 0.3, 1000, s.consistent});
  Pin pin = pin_where(block.vertices, [](const Vec3& p) { return p.x() < -0.09; });
  for (int& v : pin.vertices) v += range.first;
  builder.add_pin(pin);
  TriangleMesh sheet = grid_sheet(0.3, 0.3, 3, 3);
  for (Vec3& p : sheet.vertices) p.y() += 0.5;
  const BodyRange thin =
      builder.add_membrane("sheet", sheet, {"stvk", 1e5, 0.3, 1e-3, 1e-4, BendingModel::kAuto, 0.2, s.consistent});
  builder.set_velocity(thin, Vec3::Zero(), Vec3(0.1, 0.2, 0.3));  // in free fall alone nothing would ever stretch
  std::vector<Collider> colliders;
  if (s.ground) {
    colliders.emplace_back();
    colliders.back().world_from_shape.translation() = Vec3(0, -0.2, 0);
  }
  ContactSettings contact;
  contact.hardness = kExplicitHardness;
  return builder.finish(Vec3(0, -9.81, 0), {s.drag, 0, s.beta}, std::move(colliders), contact);
}

/// The dense eigenvalues of M^-1 K at the start, by central differences of the gradients.
Eigen::VectorXd dense_eigenvalues(const Model& model) {
  const Pins pins(model);
  MassMatrix mass(model, pins.fixed());
  const Eigen::Index n = model.x0.size();
  const auto force = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
    for (const auto& term : model.potentials)
      if (term->kind() != EnergyKind::kContact) term->add_gradient(x, g);
    return g;
  };
  const double e = 1e-6;
  Eigen::MatrixXd A = matrix_of(n, [&](const Eigen::VectorXd& q, Eigen::VectorXd& out) {
    Eigen::VectorXd free = q;
    pins.zero(free);
    out = (force(model.x0 + e * free) - force(model.x0 - e * free)) / (2 * e);
    mass.solve(out);
  });
  Eigen::VectorXd values = A.eigenvalues().real();
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace

TEST_CASE("the fastest mode is the largest eigenvalue of M^-1 K, within the bound that comes with it") {
  for (const bool consistent : {false, true}) {
    CAPTURE(consistent);
    const Model model = block_and_sheet({.consistent = consistent});
    const double truth = std::sqrt(dense_eigenvalues(model).maxCoeff());
    Linearization linear(model, 1e-3);
    const std::vector<Mode> modes = linear.fastest(Touch::kNone);
    REQUIRE(modes.size() == 1);  // nothing is damped
    CHECK(modes[0].damping_ratio == 0);
    CHECK(modes[0].omega <= truth * (1 + 1e-6));
    CHECK(modes[0].omega > 0.995 * truth);
    CHECK(modes[0].omega_bound > truth * (1 - 1e-6));
    CHECK(linear.products() < 60);
    CHECK(model.bodies[static_cast<size_t>(place_of(model, modes[0]).body)].name == "sheet");
  }
}

TEST_CASE("the fastest mode of one body leaves the others out") {
  const Model both = block_and_sheet({});
  Linearization linear(both, 1e-3);
  const double sheet = linear.fastest(Touch::kNone, &both.bodies[1])[0].omega;
  const double block = linear.fastest(Touch::kNone, &both.bodies[0])[0].omega;
  CHECK(sheet == doctest::Approx(linear.fastest(Touch::kNone)[0].omega).epsilon(0.005));
  CHECK(block < 0.5 * sheet);
  CHECK(block > 0);
}

TEST_CASE("Rayleigh damping gives the fastest mode the damping ratio beta omega/2, drag the ratio rate/(2 omega)") {
  const Model rayleigh = block_and_sheet({.beta = 1e-4});
  for (const Mode& mode : Linearization(rayleigh, 1e-3).fastest(Touch::kNone))
    CHECK(mode.damping_ratio == doctest::Approx(0.5e-4 * mode.omega).epsilon(1e-6));
  const Model dragged = block_and_sheet({.drag = 3});
  for (const Mode& mode : Linearization(dragged, 1e-3).fastest(Touch::kNone))
    CHECK(mode.damping_ratio == doctest::Approx(1.5 / mode.omega).epsilon(1e-6));
}

TEST_CASE("a vertex on a collider adds the second derivative of its penalty at the surface") {
  const double h = 1e-3;
  const Model model = block_and_sheet({.ground = true});
  Linearization linear(model, h);
  const double free = linear.fastest(Touch::kNone)[0].omega, touching = linear.fastest(Touch::kAll)[0].omega;
  // psi''/m = 2 c/h^2 of every vertex along the normal: at least that, and at most that on top of the free mode.
  const double contact = 2 * kExplicitHardness / (h * h);
  CHECK(touching * touching >= contact * (1 - 1e-6));
  CHECK(touching * touching <= (contact + free * free) * 1.006);
  linear.set_step(2 * h);
  CHECK(linear.fastest(Touch::kAll)[0].omega < touching);
}

TEST_CASE("a stretched sheet of stvk is faster, by the factor that its energy gives") {
  ModelBuilder builder;
  builder.add_mass_spring("pair", {{Vec3(0, 0, 0), Vec3(1, 0, 0)}, {}}, {{0, 1, 1.0, 1.0}}, 1, 0);
  Model springs = builder.finish(Vec3::Zero(), {}, {}, {});
  springs.masses.setConstant(1);
  // k (n n^T + (1 - L/l)(I - n n^T)): along the spring nothing changes.
  CHECK(Linearization(springs, 1e-3, 1.2).fastest(Touch::kNone)[0].omega == doctest::Approx(std::sqrt(2.0)));
  const Model sheet = block_and_sheet({.material = "stvk"});
  const double rest = Linearization(sheet, 1e-3).fastest(Touch::kNone)[0].omega;
  const double stretched = Linearization(sheet, 1e-3, 1.2).fastest(Touch::kNone)[0].omega;
  CHECK(stretched > 1.2 * rest);  // d2 psi/d s2 of stvk grows by (3 s^2 - 1)/2 in the direction of s alone
  CHECK(stretched < 2 * rest);
}

TEST_CASE("nothing to find: no vertex is free, or nothing is elastic") {
  ModelBuilder builder;
  builder.add_points("points", {Vec3(0, 0, 0), Vec3(1, 0, 0)}, {1, 1}, {}, 0);
  const Model loose = builder.finish(Vec3::Zero(), {}, {}, {});
  CHECK(Linearization(loose, 1e-3).fastest(Touch::kNone)[0].omega == 0);
  ModelBuilder again;
  again.add_points("points", {Vec3(0, 0, 0), Vec3(1, 0, 0)}, {1, 1}, {{0, 1, 5, 1}}, 0);
  again.add_pin({{0, 1}, {true, true, true}, {}});
  const Model held = again.finish(Vec3::Zero(), {}, {}, {});
  CHECK(Linearization(held, 1e-3).fastest(Touch::kNone)[0].omega == 0);
  CHECK(std::isinf(largest_step("symplectic-euler", {0, 0}, 1)));
}

TEST_CASE("the largest step is the limit of theory, less what a long clip asks of methods that grow slowly") {
  const double duration = 10;
  CHECK(largest_step("symplectic-euler", {100, 0}, duration) == doctest::Approx(0.02).epsilon(1e-3));
  CHECK(largest_step("verlet", {100, 0}, duration) == doctest::Approx(0.02).epsilon(1e-3));
  CHECK(largest_step("leapfrog", {100, 0}, duration) == doctest::Approx(0.02).epsilon(1e-3));
  CHECK(largest_step("rk4", {100, 0}, duration) == doctest::Approx(0.0283).epsilon(1e-3));
  CHECK(std::isinf(largest_step("implicit-euler", {100, 0}, duration)));
  // (1 + w^2)^(T/(2 h)) = 2 with w = h omega small: h = 2 ln 2/(omega^2 T); heun: w^4/8 a step.
  CHECK(largest_step("forward-euler", {100, 0}, duration) ==
        doctest::Approx(2 * std::log(2) / (1e4 * duration)).epsilon(1e-2));
  CHECK(largest_step("heun", {100, 0}, duration) ==
        doctest::Approx(std::cbrt(8 * std::log(2) / (1e8 * duration))).epsilon(1e-2));
  // z = -1: (h w)^2 + 4 xi h w = 4.
  const double xi = 0.3, w = -2 * xi + std::sqrt(4 * xi * xi + 4);
  CHECK(largest_step("symplectic-euler", {100, xi}, duration) == doctest::Approx(w / 100).epsilon(1e-3));
}

TEST_CASE("the fixed-point iteration converges up to h omega = 1, 2, 2 and 1.5") {
  CHECK(largest_fixed_point_step("implicit-euler", {10, 0}) == doctest::Approx(0.1).epsilon(1e-5));
  CHECK(largest_fixed_point_step("newmark", {10, 0}) == doctest::Approx(0.2).epsilon(1e-5));
  CHECK(largest_fixed_point_step("implicit-midpoint", {10, 0}) == doctest::Approx(0.2).epsilon(1e-5));
  CHECK(largest_fixed_point_step("bdf2", {10, 0}) == doctest::Approx(0.15).epsilon(1e-5));
}

TEST_CASE("real runs hold at 0.95 of the predicted step and blow up at 1.05, damped and undamped") {
  for (const char* integrator : {"symplectic-euler", "verlet", "leapfrog", "rk4"})
    for (const double beta : {0.0, 2e-4})
      for (const double factor : {0.95, 1.05}) {
        CAPTURE(std::string(integrator));
        CAPTURE(beta);
        CAPTURE(factor);
        // Held modes of a linear material, so that nothing but the step decides.
        const Scene scene{.material = "linear", .beta = beta};
        double h = 1e-3;
        for (int round = 0; round < 4; ++round) {
          const Model model = block_and_sheet(scene);
          double limit = 1;
          for (const Mode& m : Linearization(model, h).fastest(Touch::kNone))
            limit = std::min(limit, largest_step(integrator, {m.omega_bound, m.damping_ratio}, 1));
          h = limit;
        }
        Simulation run(block_and_sheet(scene), exact(integrator));
        // Below the limit energy is bounded by about 1/(1 - 0.95^2) of what gravity puts in.
        double most = 0;
        bool ended = false;
        for (int step = 0; step < 400 && !ended; ++step) {
          ended = !run.step(factor * h).converged;
          const Energies e = run.energies();
          most = std::max(most, e.kinetic + e.elastic);
          ended = ended || most > 1e6;
        }
        if (factor < 1)
          CHECK(most < 10);
        else
          CHECK(ended);
      }
}
