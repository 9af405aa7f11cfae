// Scalar fields: their matrices, closed forms of the three equations, orders in space and time.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "sim/field.h"
#include "sim/field_solver.h"
#include "sim/field_stability.h"
#include "sim/grids.h"
#include "sim/mesh_topology.h"
#include "sim/parallel.h"

using namespace softreel::sim;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHot = 5;

FieldFunction constant(double c) {
  return {[c](const Vec3&, double) { return c; }, false};
}
FieldFunction steady(double (*f)(const Vec3&)) {
  return {[f](const Vec3& x, double) { return f(x); }, false};
}
FieldFunction in_time(double (*f)(const Vec3&, double)) { return {f, true}; }

FixedValues boundary_of(const TriangleMesh& mesh, FieldFunction value) {
  return {boundary_vertices(mesh), std::move(value)};
}

/// Unit square in the xz plane, corners at +-1/2.
TriangleMesh square(int cells) { return grid_sheet(1, 1, cells, cells); }

/// The same with its inner vertices moved by up to 0.3 of a cell, the same way in every run.
TriangleMesh uneven_square(int cells) {
  TriangleMesh mesh = square(cells);
  std::vector<bool> outer(mesh.vertices.size(), false);
  for (int v : boundary_vertices(mesh)) outer[static_cast<size_t>(v)] = true;
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double a = std::fmod(0.754877666 * static_cast<double>(i + 1), 1.0);
    const double b = std::fmod(0.569840291 * static_cast<double>(i + 1), 1.0);
    if (!outer[i]) mesh.vertices[i] += 0.3 / cells * Vec3(2 * a - 1, 0, 2 * b - 1);
  }
  return mesh;
}

/// Unit sphere: every triangle of an octahedron cut into n^2.
TriangleMesh sphere(int n) {
  TriangleMesh mesh;
  std::map<std::array<long, 3>, int> at;
  const auto vertex = [&](const Vec3& p) {
    const std::array<long, 3> key{std::lround(p.x() * n), std::lround(p.y() * n), std::lround(p.z() * n)};
    const auto [place, added] = at.emplace(key, static_cast<int>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(p.normalized());
    return place->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 a(octant & 1 ? 1 : -1, 0, 0), b(0, octant & 2 ? 1 : -1, 0), c(0, 0, octant & 4 ? 1 : -1);
    const bool turned = a.cross(b).dot(c) < 0;
    const auto point = [&](int i, int j) { return vertex(((n - i - j) * a + i * b + j * c) / n); };
    const auto add = [&](int p, int q, int r) {
      mesh.triangles.push_back(turned ? Triangle{p, r, q} : Triangle{p, q, r});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < n) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
  }
  return mesh;
}

// Zero on the boundary of the unit square around the origin; -Laplace of it is 2 pi^2 times itself.
double mode(const Vec3& p) { return std::sin(kPi * (p.x() + 0.5)) * std::sin(kPi * (p.z() + 0.5)); }
Vec3 mode_gradient(const Vec3& p) {
  const double x = kPi * (p.x() + 0.5), z = kPi * (p.z() + 0.5);
  return {kPi * std::cos(x) * std::sin(z), 0, kPi * std::sin(x) * std::cos(z)};
}

struct SpaceErrors {
  double l2 = 0, h1 = 0;
};

/// Of the piecewise linear u against `mode`, by the seven-point rule of degree 5 (Dunavant 1985).
SpaceErrors errors_against_mode(const TriangleMesh& mesh, const Eigen::VectorXd& u) {
  constexpr double a = 0.470142064105115, b = 0.101286507323456;
  constexpr double wa = 0.132394152788506, wb = 0.125939180544827;
  struct Point {
    double l0, l1, l2, w;
  };
  const Point points[] = {{1.0 / 3, 1.0 / 3, 1.0 / 3, 0.225},
                          {a, a, 1 - 2 * a, wa},
                          {a, 1 - 2 * a, a, wa},
                          {1 - 2 * a, a, a, wa},
                          {b, b, 1 - 2 * b, wb},
                          {b, 1 - 2 * b, b, wb},
                          {1 - 2 * b, b, b, wb}};
  SpaceErrors sum;
  for (size_t e = 0; e < mesh.triangles.size(); ++e) {
    const HatTriangle hats = hat_triangle(mesh, static_cast<int>(e));
    const Triangle& t = mesh.triangles[e];
    Vec3 gradient = Vec3::Zero();
    for (size_t k = 0; k < 3; ++k) gradient += u(t[k]) * hats.gradient[k];
    for (const Point& q : points) {
      const Vec3 x = q.l0 * mesh.vertices[static_cast<size_t>(t[0])] + q.l1 * mesh.vertices[static_cast<size_t>(t[1])] +
                     q.l2 * mesh.vertices[static_cast<size_t>(t[2])];
      const double value = q.l0 * u(t[0]) + q.l1 * u(t[1]) + q.l2 * u(t[2]);
      sum.l2 += q.w * hats.area * std::pow(value - mode(x), 2);
      sum.h1 += q.w * hats.area * (gradient - mode_gradient(x)).squaredNorm();
    }
  }
  return {std::sqrt(sum.l2), std::sqrt(sum.h1)};
}

Eigen::VectorXd at_vertices(const TriangleMesh& mesh, double (*f)(const Vec3&)) {
  Eigen::VectorXd u(static_cast<Eigen::Index>(mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i) u(static_cast<Eigen::Index>(i)) = f(mesh.vertices[i]);
  return u;
}

void must_step(Field& field, double h, int steps) {
  for (int i = 0; i < steps; ++i) {
    const StepReport report = field.step(h);
    REQUIRE_MESSAGE(report.converged, report.reason);
  }
}

FieldProblem standing_mode(const std::string& equation, const TriangleMesh& mesh) {
  FieldProblem p;
  p.equation = equation;
  p.mesh = mesh;
  p.initial = steady(mode);
  p.fixed = {boundary_of(mesh, constant(0))};
  return p;
}

/// What M u' = -K u (or M u'' = -K u, from rest) does exactly: through the eigenvectors of the free vertices.
class SemiDiscrete {
 public:
  explicit SemiDiscrete(const Field& field) {
    const TriangleMesh& mesh = field.problem().mesh;
    std::vector<bool> held(mesh.vertices.size(), false);
    for (const FixedValues& f : field.problem().fixed)
      for (int v : f.vertices) held[static_cast<size_t>(v)] = true;
    for (size_t i = 0; i < held.size(); ++i)
      if (!held[i]) free_.push_back(static_cast<int>(i));
    const Eigen::MatrixXd K = field.stiffness(), M = field.mass();
    vectors_.compute(K(free_, free_), M(free_, free_));
    start_ = vectors_.eigenvectors().transpose() * M(free_, free_) * field.value()(free_);
  }
  const Eigen::VectorXd& eigenvalues() const { return vectors_.eigenvalues(); }
  template <class F>
  Eigen::VectorXd at(const F& factor) const {
    return vectors_.eigenvectors() * start_.cwiseProduct(vectors_.eigenvalues().unaryExpr(factor));
  }
  const std::vector<int>& free() const { return free_; }

 private:
  std::vector<int> free_;
  Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> vectors_;
  Eigen::VectorXd start_;
};

double order_of(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

TEST_CASE(
    "the stiffness of a field is symmetric, has zero row sums, no negative eigenvalue, and is exact for linear "
    "functions") {
  const TriangleMesh mesh = uneven_square(6);
  const ScalarMatrix K = assemble_stiffness(mesh);
  const Eigen::MatrixXd dense = K;
  const double norm = dense.norm();
  CHECK((dense - dense.transpose()).norm() <= 1e-14 * norm);
  CHECK(dense.rowwise().sum().norm() <= 1e-14 * norm);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
  CHECK(eigenvalues(0) >= -1e-13 * norm);
  CHECK(eigenvalues(1) > 1e-3 * norm / static_cast<double>(dense.rows()));  // only the constants are free
  // u = 2x - 3z: energy |grad u|^2 area = 13, and no residual at an inner vertex.
  const Eigen::VectorXd u = at_vertices(mesh, [](const Vec3& p) { return 2 * p.x() - 3 * p.z(); });
  CHECK(u.dot(dense * u) == doctest::Approx(13).scale(0).epsilon(1e-13));
  Eigen::VectorXd residual = dense * u;
  for (int v : boundary_vertices(mesh)) residual(v) = 0;
  CHECK(residual.norm() <= 1e-13 * norm);
}

TEST_CASE("the mass of a field sums to the area, the consistent one integrates products of linear functions exactly") {
  const TriangleMesh mesh = uneven_square(6);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(mesh.vertices.size()));
  const Eigen::VectorXd x = at_vertices(mesh, [](const Vec3& p) { return p.x(); });
  const ScalarMatrix lumped = assemble_mass(mesh, FieldMass::kLumped);
  const ScalarMatrix consistent = assemble_mass(mesh, FieldMass::kConsistent);
  CHECK(one.dot(lumped * one) == doctest::Approx(1).scale(0).epsilon(1e-13));
  CHECK(one.dot(consistent * one) == doctest::Approx(1).scale(0).epsilon(1e-13));
  CHECK((consistent * one - lumped * one).norm() <= 1e-15);
  CHECK(x.dot(consistent * x) == doctest::Approx(1.0 / 12).scale(0).epsilon(1e-13));
  CHECK(lumped.nonZeros() == one.size());
}

TEST_CASE("poisson reproduces linear functions to rounding on an uneven mesh") {
  FieldProblem p;
  p.mesh = uneven_square(9);
  p.fixed = {boundary_of(p.mesh, steady([](const Vec3& x) { return 1 + 2 * x.x() - 3 * x.z(); }))};
  const Field field(p, "");
  const Eigen::VectorXd exact = at_vertices(p.mesh, [](const Vec3& x) { return 1 + 2 * x.x() - 3 * x.z(); });
  CHECK((field.value() - exact).cwiseAbs().maxCoeff() <= 1e-12);
}

TEST_CASE("poisson on the unit square converges with order 2 in L2 and order 1 in H1") {
  for (const bool uneven : {false, true}) {
    CAPTURE(uneven);
    SpaceErrors coarse;
    for (int cells = 8; cells <= 64; cells *= 2) {
      FieldProblem p;
      p.mesh = uneven ? uneven_square(cells) : square(cells);
      p.source = steady([](const Vec3& x) { return 2 * kPi * kPi * mode(x); });
      p.fixed = {boundary_of(p.mesh, constant(0))};
      const Field field(p, "");
      const SpaceErrors fine = errors_against_mode(p.mesh, field.value());
      if (cells > 8) {
        MESSAGE(cells << " cells: L2 " << fine.l2 << " (order " << order_of(coarse.l2, fine.l2) << "), H1 " << fine.h1
                      << " (order " << order_of(coarse.h1, fine.h1) << ")");
      }
      if (cells > 16) {  // from the third mesh on
        CHECK(order_of(coarse.l2, fine.l2) == doctest::Approx(2).scale(0).epsilon(0.05));
        CHECK(order_of(coarse.h1, fine.h1) == doctest::Approx(1).scale(0).epsilon(0.1));
      }
      coarse = fine;
    }
  }
}

TEST_CASE("poisson without a fixed value is refused, also on one piece of two") {
  FieldProblem p;
  p.mesh = square(4);
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
  const auto n = static_cast<int>(p.mesh.vertices.size());
  TriangleMesh two = p.mesh;
  for (const Vec3& v : p.mesh.vertices) two.vertices.push_back(v + Vec3(5, 0, 0));
  for (const Triangle& t : p.mesh.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  p.mesh = two;
  p.fixed = {{{0}, constant(1)}};
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
  p.fixed.push_back({{n}, constant(2)});
  const Field field(p, "");
  CHECK(field.value()(n - 1) == doctest::Approx(1));
  CHECK(field.value()(2 * n - 1) == doctest::Approx(2));
}

TEST_CASE("a mesh with a flat triangle or a vertex of no triangle is refused") {
  FieldProblem p;
  p.mesh = square(2);
  p.mesh.vertices.emplace_back(3, 0, 0);
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
  p.mesh = square(2);
  p.mesh.triangles.push_back({0, 1, 2});  // on one line
  CHECK_THROWS_AS(Field(p, ""), std::invalid_argument);
}

TEST_CASE("poisson goes with a load that varies, and is left alone by one that does not") {
  FieldProblem p;
  p.mesh = square(8);
  p.fixed = {boundary_of(p.mesh, constant(0))};
  p.source = constant(3);
  Field still(p, "");
  const Eigen::VectorXd u = still.value();
  must_step(still, 0.5, 2);
  CHECK(still.value() == u);
  CHECK(still.time() == 1);
  p.source = in_time([](const Vec3&, double t) { return 3 * (1 + t); });
  Field moving(p, "");
  CHECK(moving.value() == u);
  must_step(moving, 0.5, 2);
  CHECK((moving.value() - 2 * u).cwiseAbs().maxCoeff() <= 1e-14);
}

TEST_CASE("maximum principle: on right-angled triangles poisson and implicit heat stay within their data") {
  // Non-obtuse triangles make K an M-matrix (Ciarlet, Raviart 1973); so does lumped mass added to it.
  FieldProblem p;
  p.mesh = square(12);
  p.fixed = {boundary_of(p.mesh, steady([](const Vec3& x) { return std::sin(9 * x.x()) * std::cos(7 * x.z()); }))};
  const Field poisson(p, "");
  double low = 1e9, high = -1e9;
  for (int v : p.fixed[0].vertices) {
    low = std::min(low, poisson.value()(v));
    high = std::max(high, poisson.value()(v));
  }
  CHECK(poisson.value().minCoeff() >= low - 1e-14);
  CHECK(poisson.value().maxCoeff() <= high + 1e-14);
  p.equation = "heat";
  p.initial = steady([](const Vec3& x) { return x.norm() < 0.2 ? kHot : 0.0; });
  Field heat(p, "implicit-euler");
  low = std::min(low, 0.0);
  high = std::max(high, kHot);
  for (double h : {1e-4, 1e-2, 1.0}) {
    must_step(heat, h, 5);
    CHECK(heat.value().minCoeff() >= low - 1e-14);
    CHECK(heat.value().maxCoeff() <= high + 1e-14);
  }
}

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

TEST_CASE(
    "the energy of a wave: implicit Euler never gains, trapezoid and midpoint keep it, symplectic Euler stays within a "
    "band of order h") {
  const FieldProblem p = standing_mode("wave", square(12));
  const auto total = [](const Field& f) { return f.energies().kinetic + f.energies().potential; };
  {
    Field field(p, "implicit-euler");
    double before = total(field);
    for (int i = 0; i < 200; ++i) {
      must_step(field, 0.02, 1);
      CHECK(total(field) <= before * (1 + 1e-12));
      before = total(field);
    }
  }
  // Of a linear equation the trapezoid and the midpoint keep the energy; what is lost is the rounding of each solve.
  for (const char* name : {"newmark", "implicit-midpoint"}) {
    CAPTURE(name);
    Field field(p, name);
    const double start = total(field);
    must_step(field, 0.05, 400);
    CHECK(total(field) == doctest::Approx(start).scale(0).epsilon(1e-11));
  }
  // The modified energy that symplectic Euler keeps differs by (h/2) v^T K u, at most (h omega/2) E.
  const double omega = kPi * std::numbers::sqrt2;
  for (double h : {0.01, 0.005}) {
    Field field(p, "symplectic-euler");
    const double start = total(field);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      must_step(field, h, 1);
      worst = std::max(worst, std::abs(total(field) / start - 1));
    }
    CHECK(worst <= 1.1 * 0.5 * h * omega);
  }
}

TEST_CASE("values that rise with time at the boundary are met exactly: u = t under heat and as a wave") {
  for (const std::string equation : {"heat", "wave"})
    for (const MethodInfo& info : field_integrators(equation)) {
      const std::string name(info.name);
      CAPTURE(equation);
      CAPTURE(name);
      FieldProblem p;
      p.equation = equation;
      p.mesh = uneven_square(5);
      p.diffusivity = 0.01;
      p.speed = 0.1;
      p.fixed = {boundary_of(p.mesh, in_time([](const Vec3&, double t) { return t; }))};
      if (equation == "heat") p.source = constant(1);
      p.initial_rate = constant(1);
      Field field(p, name);
      must_step(field, 0.01, 50);
      CHECK((field.value().array() - 0.5).abs().maxCoeff() <= 1e-12);
      if (equation == "wave") CHECK((field.rate().array() - 1).abs().maxCoeff() <= 1e-10);
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

TEST_CASE("the longest step of an explicit method is what theory says, and the run agrees") {
  // Limits of h lambda (heat) and h omega (wave), found by bisection on the method itself.
  const auto limit = [](const char* equation, const char* integrator) {
    double low = 0.1, high = 10;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (growth_of_a_step(equation, integrator, 1, middle) <= 1 + 1e-6 ? low : high) = middle;
    }
    return low;
  };
  for (const char* name : {"symplectic-euler", "symplectic-euler-position", "verlet", "leapfrog"})
    CHECK(limit("wave", name) == doctest::Approx(2).scale(0).epsilon(1e-3));
  CHECK(limit("wave", "rk4") == doctest::Approx(std::sqrt(8.0)).scale(0).epsilon(1e-3));
  for (const char* name : {"forward-euler", "heun", "midpoint"})
    CHECK(limit("heat", name) == doctest::Approx(2).scale(0).epsilon(1e-3));
  CHECK(limit("heat", "rk4") == doctest::Approx(2.785294).scale(0).epsilon(1e-3));
  CHECK(growth_of_a_step("wave", "implicit-euler", 1, 100) == 1);

  const FieldProblem p = standing_mode("wave", uneven_square(10));
  const Field field(p, "symplectic-euler");
  const double largest = field.largest_eigenvalue();
  const double exact = SemiDiscrete(field).eigenvalues().maxCoeff();
  CHECK(largest >= exact);         // with its margin
  CHECK(largest <= 1.06 * exact);  // and no more than that
  const double h = 2 / std::sqrt(exact);
  const auto after = [&](double step) {
    Field run(p, "symplectic-euler");
    for (int i = 0; i < 2000; ++i)
      if (!run.step(step).converged) return 1e300;
    return run.value().norm();
  };
  CHECK(after(0.98 * h) < 10 * field.value().norm());
  CHECK(after(1.02 * h) > 1e6 * field.value().norm());
  CHECK(step_holds("wave", "symplectic-euler", exact, 0.98 * h, 100));
  CHECK_FALSE(step_holds("wave", "symplectic-euler", exact, 1.02 * h, 100));
  const int steps = steps_that_hold("wave", "symplectic-euler", exact, 1, 100, 1000000);
  CHECK(steps == static_cast<int>(std::ceil(1 / h)));
  CHECK(steps_that_hold("wave", "symplectic-euler", 1e30, 1, 100, 1000) == 0);
}

TEST_CASE("a field that is resumed, and one with other threads, goes on with the same bits") {
  const int before = threads();
  for (const std::string equation : {"heat", "wave", "poisson"}) {
    std::vector<std::string> names = {""};
    if (equation != "poisson") {
      names.clear();
      for (const MethodInfo& info : field_integrators(equation)) names.emplace_back(info.name);
    }
    for (const std::string& name : names) {
      CAPTURE(equation);
      CAPTURE(name);
      FieldProblem p = standing_mode(equation, uneven_square(95));  // more vertices than a loop keeps to itself
      p.diffusivity = p.speed = 1e-3;
      p.source = in_time([](const Vec3& x, double t) { return x.x() * t; });
      set_threads(1);
      Field whole(p, name);
      must_step(whole, 0.01, 3);
      Field resumed(p, name);
      resumed.restore(whole.time(), whole.value(), whole.rate(), whole.memory());
      must_step(whole, 0.01, 3);
      set_threads(2);
      must_step(resumed, 0.01, 3);
      CHECK(resumed.value() == whole.value());
      CHECK(resumed.rate() == whole.rate());
      CHECK_THROWS_AS(resumed.restore(0, Eigen::VectorXd::Zero(3), whole.rate(), {}), std::invalid_argument);
    }
  }
  set_threads(before);
}
