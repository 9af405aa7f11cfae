// Scalar fields in motion: closed forms of heat and wave, orders in space and time.
#include <doctest/doctest.h>

#include "sim/field_solver.h"
#include "tests/sim/fields.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE("heat decays as exp(-2 pi^2 k t), with order 2 in the mesh") {
  // The mode decays at (almost) the lowest eigenvalue of the mesh; the steps in time are short enough to be out of
  // sight: implicit Euler's own error, half of h lambda relative, is taken off by Richardson's extrapolation.
  for (const FieldMass mass : {FieldMass::kLumped, FieldMass::kConsistent}) {
    double coarse = 0;
    for (int cells = 8; cells <= 32; cells *= 2) {
      FieldProblem p = standing_mode("heat", square(cells));
      p.diffusivity = 0.3;
      p.mass = mass;
      const double rate = 2 * kPi * kPi * p.diffusivity, t = 0.5 / rate;
      const auto middle_after = [&](int steps) {
        Field field(p, "implicit-euler");
        must_step(field, t / steps, steps);
        return field.value().dot(field.mass() * field.value());
      };
      const Field start(p, "implicit-euler");
      const double ratio =
          (2 * middle_after(400) - middle_after(200)) / start.value().dot(start.mass() * start.value());
      const double error = std::abs(-std::log(ratio) / (2 * rate * t) - 1);
      MESSAGE(std::string(mass == FieldMass::kLumped ? "lumped, " : "consistent, ")
              << cells << " cells: relative error of the decay rate " << error);
      // Linear elements: of the order of (pi/cells)^2 (Strang, Fix 1973, section 6.3).
      CHECK(error < std::pow(kPi / cells, 2));
      if (cells > 8) CHECK(order_of(coarse, error) == doctest::Approx(2).scale(0).epsilon(0.05));
      coarse = error;
    }
  }
}

TEST_CASE("every integrator of heat and wave has its order, against the exact solution on the same mesh") {
  for (const FieldMass mass : {FieldMass::kLumped, FieldMass::kConsistent})
    for (const std::string equation : {"heat", "wave"}) {
      const FieldProblem p = [&] {
        FieldProblem made = standing_mode(equation, uneven_square(6));
        made.diffusivity = 0.1;
        made.speed = 0.7;
        made.mass = mass;
        return made;
      }();
      for (const MethodInfo& info : field_integrators(equation)) {
        const std::string name(info.name);
        CAPTURE(equation);
        CAPTURE(name);
        const SemiDiscrete exact(Field(p, name));
        const double factor = equation == "heat" ? p.diffusivity : p.speed * p.speed;
        // Long enough for a good part of a period of the slowest mode, steps well inside of every limit.
        const double t = equation == "heat" ? 0.3 : 1.0;
        const auto worst_error = [&](int steps) {
          Field field(p, name);
          double worst = 0;
          for (int i = 1; i <= steps; ++i) {
            must_step(field, t / steps, 1);
            const double now = t * i / steps;
            const Eigen::VectorXd u = exact.at([&](double lambda) {
              return equation == "heat" ? std::exp(-factor * lambda * now) : std::cos(std::sqrt(factor * lambda) * now);
            });
            worst = std::max(worst, (field.value()(exact.free()) - u).norm());
            if (equation == "heat") continue;
            const Eigen::VectorXd v = exact.at([&](double lambda) {
              const double omega = std::sqrt(factor * lambda);
              return -omega * std::sin(omega * now);
            });
            worst = std::max(worst, (field.rate()(exact.free()) - v).norm());
          }
          return worst;
        };
        // Consistent mass makes the fastest modes twice as fast.
        const int steps = (info.order >= 4 ? 100 : 400) * (mass == FieldMass::kConsistent ? 4 : 1);
        const double order = order_of(worst_error(steps), worst_error(2 * steps));
        MESSAGE(std::string(mass == FieldMass::kLumped ? "lumped " : "consistent ")
                << equation << ", " << name << ": order " << order);
        CHECK(std::abs(order - info.order) < 0.1);
      }
    }
}

TEST_CASE("a closed sphere rings at l(l+1), with order 2 in the mesh") {
  const auto eigenvalue = [](const TriangleMesh& mesh, double (*start)(const Vec3&)) {
    const ScalarMatrix K = assemble_stiffness(mesh), M = assemble_mass(mesh, FieldMass::kLumped);
    const std::vector<std::uint8_t> none(mesh.vertices.size(), 0);
    FieldSolver solver(K, M, none);
    Eigen::VectorXd x = at_vertices(mesh, start);
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(x.size());
    for (int k = 0; k < 30; ++k) {  // inverse iteration, the symmetry of the start keeps other modes out
      x -= one * (one.dot(M * x) / one.dot(M * one));
      x /= x.norm();
      const Eigen::VectorXd b = M * x;
      REQUIRE(solver.solve(1, 0.5, b, x));
    }
    return x.dot(K * x) / x.dot(M * x);
  };
  double coarse[2] = {};
  for (int n = 6; n <= 24; n *= 2) {
    const TriangleMesh mesh = sphere(n);
    CHECK(boundary_vertices(mesh).empty());
    const double errors[2] = {std::abs(eigenvalue(mesh, [](const Vec3& p) { return p.x(); }) / 2 - 1),
                              std::abs(eigenvalue(mesh, [](const Vec3& p) { return p.x() * p.y(); }) / 6 - 1)};
    for (int l = 0; l < 2; ++l) {
      MESSAGE(n << " parts, l = " << l + 1 << ": relative error " << errors[l]);
      // Of l = 1, the coordinates themselves, this mesh makes order 4: K x is the gradient of the area.
      if (n > 6) CHECK(order_of(coarse[l], errors[l]) > 1.9);
      coarse[l] = errors[l];
    }
  }
}

TEST_CASE("a standing wave swings at pi sqrt(2) c and keeps its shape, with order 2 in the mesh") {
  double coarse = 0;
  for (int cells = 8; cells <= 32; cells *= 2) {
    FieldProblem p = standing_mode("wave", square(cells));
    p.speed = 2;
    Field field(p, "symplectic-euler");
    const double omega = kPi * std::numbers::sqrt2 * p.speed, period = 2 * kPi / omega;
    const Eigen::VectorXd shape = field.value(), weighted = field.mass() * shape;
    // Two periods; the method's own shift of the frequency is (h omega)^2/24.
    const int steps = 256 * cells;
    must_step(field, 2 * period / steps, steps);
    const double swing = weighted.dot(field.value()) / weighted.dot(shape);
    const double rate = weighted.dot(field.rate()) / weighted.dot(shape);
    const double phase = std::atan2(-rate / omega, swing);
    const double error = std::abs(phase) / (4 * kPi);
    const double other = (field.value() - swing * shape).norm() / shape.norm();
    MESSAGE(cells << " cells: relative error of the frequency " << error << ", other shapes " << other);
    // Half of the relative error of the eigenvalue.
    CHECK(error < 0.5 * std::pow(kPi / cells, 2));
    CHECK(other < std::pow(kPi / cells, 2));
    if (cells > 8) CHECK(order_of(coarse, error) == doctest::Approx(2).scale(0).epsilon(0.05));
    coarse = error;
  }
}

TEST_CASE("a source that varies drives a wave as the closed form says") {
  // Free boundary, nothing varies in space: u'' = cos(3t), u = (1 - cos 3t)/9.
  for (const MethodInfo& info : field_integrators("wave")) {
    const std::string name(info.name);
    CAPTURE(name);
    FieldProblem p;
    p.equation = "wave";
    p.mesh = square(3);
    p.source = in_time([](const Vec3&, double t) { return std::cos(3 * t); });
    const auto error = [&](int steps) {
      Field field(p, name);
      must_step(field, 1.0 / steps, steps);
      return std::abs(field.value()(5) - (1 - std::cos(3.0)) / 9);
    };
    const int steps = info.order >= 4 ? 10 : 100;
    // At least its order: a quadrature in time may do better.
    CHECK(order_of(error(steps), error(2 * steps)) > info.order - 0.1);
  }
}
