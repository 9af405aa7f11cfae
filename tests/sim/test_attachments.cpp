// Ties between bodies.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/attachment.h"
#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/nearest_point.h"
#include "sim/simulation.h"
#include "tests/sim/derivatives.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

TetMesh moved(TetMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

std::vector<int> everyone(const TetMesh& mesh) {
  std::vector<int> all(mesh.vertices.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

Momenta momenta(const Simulation& s) {
  Momenta m;
  for (int i = 0; i < s.model().vertices(); ++i) {
    const Vec3 p = s.model().masses(i) * s.state().v.segment<3>(3 * i);
    m.linear += p;
    m.angular += Vec3(s.state().x.segment<3>(3 * i)).cross(p);
  }
  return m;
}

/// An upper cube tied to a lower one; both free. `gap` between them [m].
struct Pair {
  ModelBuilder builder;
  TetMesh lower = block_of_tets(Vec3(0.2, 0.2, 0.2), 3, 3, 3), upper;
  BodyRange b, a;
  std::vector<Tie> ties;

  Pair(double gap, const SolidMaterial& below, const SolidMaterial& above, AttachSettings settings = {})
      : upper(moved(block_of_tets(Vec3(0.17, 0.2, 0.19), 2, 2, 2), Vec3(0.01, 0.2 + gap, 0))) {
    b = builder.add_solid("lower", lower, below);
    a = builder.add_solid("upper", upper, above);
    if (settings.near <= 0) settings.near = gap + 1e-6;
    ties = find_ties({a.first, &upper.vertices, boundary_triangles(upper)}, everyone(upper),
                     {b.first, &lower.vertices, boundary_triangles(lower)}, settings, builder.stiffness());
    builder.add_ties(ties, 0);
  }
};

}  // namespace

TEST_CASE("the tree finds the same nearest point as a look at every triangle") {
  TriangleMesh mesh = grid_sheet(1, 1, 12, 9);
  for (Vec3& v : mesh.vertices) v.y() = 0.3 * std::sin(5 * v.x()) * std::cos(4 * v.z());
  const NearestPointTree tree(mesh.vertices, mesh.triangles);
  const Eigen::VectorXd points = random_vector(600, 1, 3);
  for (Eigen::Index i = 0; i < 200; ++i) {
    const Vec3 p = points.segment<3>(3 * i);
    double nearest = 1e9;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 &a = mesh.vertices[static_cast<size_t>(t[0])], &b = mesh.vertices[static_cast<size_t>(t[1])],
                 &c = mesh.vertices[static_cast<size_t>(t[2])];
      const Vec3 w = nearest_weights(p, a, b, c);
      CHECK(w.sum() == doctest::Approx(1));
      CHECK(w.minCoeff() >= 0);
      const Vec3 q = w(0) * a + w(1) * b + w(2) * c;
      nearest = std::min(nearest, (p - q).norm());
      // Nearest: no way within the triangle leads nearer.
      for (const Vec3& corner : {a, b, c}) CHECK((p - q).dot(corner - q) < 1e-12);
    }
    CHECK(tree.find(p).distance == doctest::Approx(nearest).scale(0).epsilon(1e-14));
  }
}

TEST_CASE("ties keep linear and angular momentum, touching or across a gap, whatever moves") {
  // Symplectic Euler keeps both to rounding for forces that are functions of distances.
  for (double gap : {0.0, 0.03}) {
    CAPTURE(gap);
    Pair pair(gap, {"stable-neo-hookean", 1e4, 0.3, 1000}, {"stable-neo-hookean", 1e5, 0.3, 300});
    CHECK(pair.ties.size() == 9);
    for (const Tie& tie : pair.ties) CHECK((tie.length > 0) == (gap > 0));
    pair.builder.set_velocity(pair.a, Vec3(0.5, 0.2, -0.3), Vec3(3, 2, 5));
    Simulation s(pair.builder.finish(Vec3::Zero(), {}, {}, {}), {"symplectic-euler", "auto", {}, 0});
    const Momenta before = momenta(s);
    for (int i = 0; i < 4000; ++i) REQUIRE(s.step(1e-4).converged);
    const Momenta after = momenta(s);
    CHECK((after.linear - before.linear).norm() < 1e-11 * before.linear.norm());
    CHECK((after.angular - before.angular).norm() < 1e-11 * before.angular.norm());
    // And the pair has stayed together.
    const Eigen::VectorXd& x = s.state().x;
    for (const Tie& tie : pair.ties) {
      Vec3 p = x.segment<3>(3 * tie.vertex);
      for (size_t j = 0; j < 3; ++j) p -= tie.weights(static_cast<Eigen::Index>(j)) * x.segment<3>(3 * tie.corners[j]);
      CHECK(std::abs(p.norm() - tie.length) < 0.01);
    }
  }
}

TEST_CASE("a tied pair turned as a whole has no energy, apart across a gap it does not shear") {
  Pair pair(0.03, {"stable-neo-hookean", 1e4, 0.3, 1000}, {"stable-neo-hookean", 1e4, 0.3, 1000});
  const Eigen::VectorXd x = pair.builder.positions();
  const auto terms = make_ties(pair.ties);
  const Eigen::Matrix3d R = euler_xyz({50, -20, 130});
  Eigen::VectorXd turned = x, sheared = x;
  for (Eigen::Index i = 0; i < x.size() / 3; ++i) turned.segment<3>(3 * i) = R * Vec3(x.segment<3>(3 * i));
  for (int i = pair.a.first; i < pair.a.first + pair.a.count; ++i) sheared(3 * i) += 0.001;
  double rest = 0, shear = 0;
  for (const auto& term : terms) {
    rest += term->value(turned);
    shear += term->value(sheared);
  }
  double k = 0;
  for (const Tie& tie : pair.ties) k += tie.stiffness;
  CHECK(rest < 1e-20 * k);
  CHECK(shear > 0.2 * 0.5 * k * 1e-6);
}

TEST_CASE("two points tied together swing with their reduced mass") {
  // omega^2 = k (1/m1 + 1/m2); symplectic Euler's period is that to (h omega)^2/24.
  ModelBuilder builder;
  const std::vector<Vec3> one = {Vec3(0, 0, 0)}, other = {Vec3(0.5, 0, 0)};
  const BodyRange a = builder.add_points("a", one, {0.3}, {}, 0), b = builder.add_points("b", other, {0.7}, {}, 0);
  AttachSettings settings;
  settings.near = 1;
  settings.stiffness = 40;
  const std::vector<int> first = {0};
  const auto ties = find_ties({a.first, &one, {}}, first, {b.first, &other, {}}, settings, builder.stiffness());
  REQUIRE(ties.size() == 1);
  CHECK(ties[0].length == 0.5);
  builder.add_ties(ties, 0);
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.x0(3) = 0.51;
  Simulation s(std::move(model), {"symplectic-euler", "auto", {}, 0});
  const double period = 2 * std::numbers::pi / std::sqrt(40 * (1 / 0.3 + 1 / 0.7)), h = period / 1000;
  double last = 0.01, crossed = 0;
  int crossings = 0;
  while (crossings < 10) {
    REQUIRE(s.step(h).converged);
    const double u = s.state().x(3) - s.state().x(0) - 0.5;
    if (last > 0 && u <= 0) {
      const double t = s.state().t - h * u / (u - last);
      if (++crossings == 1) crossed = t;
      if (crossings == 10) CHECK((t - crossed) / 9 == doctest::Approx(period).scale(0).epsilon(1e-5));
    }
    last = u;
  }
}

TEST_CASE("two free points tied without a stiffness are refused") {
  ModelBuilder builder;
  const std::vector<Vec3> one = {Vec3(0, 0, 0)}, other = {Vec3(0.5, 0, 0)};
  builder.add_points("a", one, {1}, {}, 0);
  builder.add_points("b", other, {1}, {}, 0);
  AttachSettings settings;
  settings.near = 1;
  const std::vector<int> first = {0};
  CHECK_THROWS_AS(find_ties({0, &one, {}}, first, {1, &other, {}}, settings, builder.stiffness()),
                  std::invalid_argument);
}

TEST_CASE("neighbours of Young 1e4 and 1e8, and of mass ratio 1e6, hang on each other and converge") {
  const SolidMaterial soft{"stable-neo-hookean", 1e4, 0.3, 10}, stiff{"stable-neo-hookean", 1e8, 0.3, 10},
      heavy{"stable-neo-hookean", 1e8, 0.3, 1e4}, light{"stable-neo-hookean", 1e4, 0.3, 1e-2};
  const std::pair<SolidMaterial, SolidMaterial> kPairs[] = {
      {stiff, soft}, {soft, stiff}, {heavy, light}, {light, heavy}};
  for (const char* linear : {"cholesky", "cg"})
    for (const auto& [below, above] : kPairs) {
      CAPTURE(linear);
      CAPTURE(below.young);
      CAPTURE(below.density);
      CAPTURE(above.density);
      Pair pair(0, below, above);
      // The stiff one is held, so that the soft one hangs or stands on it; of the mass ratio the heavy one is held.
      Pin pin;
      const TetMesh& held = below.young > above.young ? pair.lower : pair.upper;
      const BodyRange& range = below.young > above.young ? pair.b : pair.a;
      const double end = below.young > above.young ? -0.1 : 0.3;
      for (size_t i = 0; i < held.vertices.size(); ++i)
        if (std::abs(held.vertices[i].y() - end) < 1e-9) pin.vertices.push_back(range.first + static_cast<int>(i));
      REQUIRE(!pin.vertices.empty());
      pair.builder.add_pin(pin);
      Simulation s(pair.builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), {"implicit-euler", linear, {}, 0});
      long iterations = 0;
      for (int i = 0; i < 60; ++i) {
        const StepReport r = s.step(1.0 / 60);
        REQUIRE_MESSAGE(r.converged, r.reason);
        iterations += r.newton_iterations;
      }
      CHECK(iterations < 60 * 10);
      for (const Tie& tie : pair.ties) {
        Vec3 gap = s.state().x.segment<3>(3 * tie.vertex);
        for (size_t j = 0; j < 3; ++j)
          gap -= tie.weights(static_cast<Eigen::Index>(j)) * s.state().x.segment<3>(3 * tie.corners[j]);
        CHECK(gap.norm() < 2e-3);
      }
    }
}
