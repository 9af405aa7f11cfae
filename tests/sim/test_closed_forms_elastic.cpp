// Closed forms of elastic bodies: catenary, waves, beams; and the free motions with every integrator.
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "sim/gravity.h"
#include "sim/grids.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

TEST_CASE("free fall and drag have each integrator's own closed form") {
  const double h = 0.01, t = 1, rate = 0.8;
  const int steps = 100;
  const Vec3 v0(1, 2, 3), g(0, -9.81, 0);
  for (const MethodInfo& method : integrators()) {
    if (method.order == 0) continue;
    const std::string name(method.name);
    CAPTURE(name);
    const auto body = [&](const Vec3& gravity, double drag) {
      ModelBuilder builder;
      const BodyRange range =
          builder.add_solid("ball", block_of_tets(Vec3(0.1, 0.1, 0.1), 1, 1, 1), {"corotated-volume", 1e3, 0.3, 1000});
      builder.set_velocity(range, v0, Vec3::Zero());
      Simulation s(builder.finish(gravity, {drag, 0, 0}, {}, {}), exact(name));
      must_step(s, h, steps);
      return std::pair(centre_of_mass(s), Vec3(momentum(s) / s.model().masses.sum()));
    };
    // Every method of order 2 is exact for a parabola; those of order 1 are off by half a step of gravity.
    const auto [x, v] = body(g, 0);
    const double early = name == "forward-euler" || name == "symplectic-euler-position" ? -1 : 1;
    const Vec3 expected = v0 * t + 0.5 * g * t * (method.order == 1 ? t + early * h : t);
    CHECK((x - expected).norm() < 1e-10);
    CHECK((v - (v0 + g * t)).norm() < 1e-10);
    // v' = -rate v: the stability function of the method, to the power of the steps.
    const double z = rate * h;
    const auto [x_drag, v_drag] = body(Vec3::Zero(), rate);
    double factor = std::exp(-rate * t);
    if (method.order == 1) factor = std::pow(name == "implicit-euler" ? 1 / (1 + z) : 1 - z, steps);
    if (name == "heun" || name == "midpoint") factor = std::pow(1 - z + z * z / 2, steps);
    if (name == "newmark" || name == "implicit-midpoint") factor = std::pow((1 - z / 2) / (1 + z / 2), steps);
    // rk4, bdf2, verlet and leapfrog against the exponential: their errors are below t rate z^p.
    const double tolerance = name == "rk4"                                              ? std::pow(z, 4)
                             : name == "bdf2" || name == "verlet" || name == "leapfrog" ? z * z
                                                                                        : 1e-10;
    CHECK((v_drag - factor * v0).norm() < tolerance * v0.norm());
  }
}

TEST_CASE("the damped oscillator decays and swings as it should") {
  const double k = 20, m = 0.5, c = 0.8;
  const double omega = std::sqrt(k / m), xi = c / (2 * std::sqrt(k * m)), damped = omega * std::sqrt(1 - xi * xi);
  for (const char* integrator :
       {"newmark", "implicit-midpoint", "bdf2", "heun", "midpoint", "rk4", "verlet", "leapfrog"}) {
    TriangleMesh pair;
    pair.vertices = {Vec3(0, 0, 0), Vec3(1.1, 0, 0)};
    ModelBuilder builder;
    builder.add_mass_spring("oscillator", pair, {{0, 1, k, 1.0}}, 1, c);
    builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
    Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    model.masses.setConstant(m);
    Simulation s(std::move(model), exact(integrator));
    const double h = 1e-3;
    double worst = 0;
    for (int i = 1; i <= 2000; ++i) {
      must_step(s, h, 1);
      const double t = i * h;
      const double exact_u =
          0.1 * std::exp(-xi * omega * t) * (std::cos(damped * t) + xi * omega / damped * std::sin(damped * t));
      worst = std::max(worst, std::abs(s.state().x(3) - 1 - exact_u));
    }
    CAPTURE(integrator);
    // Phase error (h omega)^2/12 omega t at most for the newmark family, four times that for bdf2; decaying amplitude.
    CHECK(worst < 0.1 * std::pow(h * omega, 2) / 3 * omega * 2);
  }
}

TEST_CASE("a hanging chain takes the shape of the elastic catenary, with order 2 in the length of its links") {
  const double span = 1, length = 1.5, weight = 2, EA = 200;  // [m], [m], [N/m], [N]
  // Irvine 1981, section 1.3: from the lowest point, x = H s/EA + H/w asinh(w s/H), y = w s^2/2EA + H/w (sqrt(1 +
  // (ws/H)^2) - 1); H from the span.
  const auto half_span = [&](double H) {
    return H * length / 2 / EA + H / weight * std::asinh(weight * length / 2 / H);
  };
  double lo = 1e-3, hi = 1e3;
  for (int i = 0; i < 200; ++i) (half_span(0.5 * (lo + hi)) < span / 2 ? lo : hi) = 0.5 * (lo + hi);
  const double H = lo, s2 = length / 2;
  const double sag = weight * s2 * s2 / 2 / EA + H / weight * (std::sqrt(1 + std::pow(weight * s2 / H, 2)) - 1);
  std::vector<double> errors;
  for (const int links : {10, 20, 40}) {
    TriangleMesh chain;
    std::vector<Spring> springs;
    const double link = length / links;
    for (int i = 0; i <= links; ++i) {
      const double s = double(i) / links;
      chain.vertices.push_back(Vec3(span * (s - 0.5), -0.3 * s * (1 - s), 0));
      if (i > 0) springs.push_back({i - 1, i, EA / link, link});
    }
    ModelBuilder builder;
    builder.add_mass_spring("chain", chain, springs, 1, 0);
    Pin ends;
    ends.vertices = {0, links};
    builder.add_pin(ends);
    Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    model.masses.setConstant(weight * link / 9.81);
    model.potentials.push_back(make_gravity(model.masses, Vec3(0, -9.81, 0)));
    SimulationSettings settings = exact("static");
    settings.minimizer.max_iterations = 500;
    settings.minimizer.tolerance = 1e-11;
    Simulation s(std::move(model), settings);
    must_step(s, 1, 1);
    errors.push_back(-s.state().x(3 * (links / 2) + 1) - sag);
  }
  MESSAGE("sag ", sag, " m; errors with 10, 20, 40 links: ", errors[0], " ", errors[1], " ", errors[2]);
  CHECK(std::log2(errors[0] / errors[1]) == doctest::Approx(2).scale(0).epsilon(0.05));
  CHECK(std::log2(errors[1] / errors[2]) == doctest::Approx(2).scale(0).epsilon(0.05));
  // A link of length l bends off its chord by l^2/8R, R >= H/w the radius of the curve.
  CHECK(std::abs(errors[2]) < std::pow(length / 40, 2) / 8 / (H / weight));
}

TEST_CASE("axial waves run with sqrt(E/rho): too slow with lumped mass, too fast with the consistent one") {
  // First axial mode of a bar that is held at one end, nu = 0: period 4L/c. Linear elements of length l change the
  // frequency by -(k l)^2/24 (lumped) and +(k l)^2/24 (consistent), k = pi/2L.
  const double L = 1, E = 1e6, rho = 1000, c = std::sqrt(E / rho), period = 4 * L / c;
  const int cells = 20;
  for (const bool consistent : {false, true}) {
    const TetMesh bar = block_of_tets(Vec3(L, 0.1, 0.1), cells, 2, 2);
    ModelBuilder builder;
    builder.add_solid("bar", bar, {"corotated-volume", E, 0.0, rho, consistent});
    builder.add_pin(pin_where(bar.vertices, [&](const Vec3& p) { return p.x() < -L / 2 + 1e-9; }));
    Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    for (int i = 0; i < model.vertices(); ++i)
      model.v0(3 * i) = 1e-3 * std::sin(std::numbers::pi / 2 * (model.x0(3 * i) + L / 2) / L);
    Simulation s(std::move(model), exact("verlet"));
    const double h = period / 4000;
    const auto end = [&] {
      double sum = 0;
      int count = 0;
      for (size_t i = 0; i < bar.vertices.size(); ++i)
        if (bar.vertices[i].x() > L / 2 - 1e-9) {
          sum += s.state().x(3 * static_cast<int>(i)) - L / 2;
          ++count;
        }
      return sum / count;
    };
    double last = 0, crossing = 0;
    for (int i = 0; i < 4400 && crossing == 0; ++i) {
      must_step(s, h, 1);
      const double u = end();
      if (i > 2400 && last < 0 && u >= 0) crossing = s.state().t - h * u / (u - last);
      last = u;
    }
    const double shift = period / crossing - 1;  // of the frequency
    const double theory = std::pow(std::numbers::pi / 2 / cells, 2) / 24;
    CAPTURE(consistent);
    MESSAGE("frequency off by ", shift, ", theory ", consistent ? theory : -theory);
    // Kuhn's tetrahedra spread mass unevenly over a cross-section, which changes the shift at its own order.
    CHECK(shift * (consistent ? 1 : -1) > 0);
    CHECK(std::abs(shift) < 2 * theory);
  }
}

TEST_CASE("a cantilever comes nearer to Timoshenko's beam with every refinement, from below") {
  // nu = 0, where a clamped end does not keep the section from straining sideways.
  const double L = 1, side = 0.2, E = 1e7, rho = 100;
  const double q = rho * 9.81 * side * side, I = std::pow(side, 4) / 12, G = E / 2, k = 10.0 / 12;
  const double theory = q * std::pow(L, 4) / (8 * E * I) + q * L * L / (2 * k * G * side * side);
  std::vector<double> ratios;
  for (const int n : {1, 2, 4, 8}) {
    const TetMesh beam = block_of_tets(Vec3(L, side, side), 5 * n, n, n);
    ModelBuilder builder;
    builder.add_solid("beam", beam, {"corotated-volume", E, 0.0, rho});
    builder.add_pin(pin_where(beam.vertices, [&](const Vec3& p) { return p.x() < -L / 2 + 1e-9; }));
    SimulationSettings settings = exact("static");
    settings.minimizer.tolerance = 1e-8;
    Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {}, {}), settings);
    must_step(s, 1, 1);
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < beam.vertices.size(); ++i)
      if (beam.vertices[i].x() > L / 2 - 1e-9) {
        sum += beam.vertices[i].y() - s.state().x(3 * static_cast<int>(i) + 1);
        ++count;
      }
    ratios.push_back(sum / count / theory);
  }
  MESSAGE("sag over Timoshenko's with 1, 2, 4, 8 cells: ", ratios[0], " ", ratios[1], " ", ratios[2], " ", ratios[3]);
  for (size_t i = 1; i < ratios.size(); ++i) CHECK(ratios[i] > ratios[i - 1]);
  CHECK(ratios.back() < 1);
  // Error of linear elements: order 2. What it tends to is the beam up to (side/L)^2 of what beam theory leaves out.
  const double limit = ratios[3] + (ratios[3] - ratios[2]) / 3;
  CHECK(limit == doctest::Approx(1).scale(0).epsilon(side * side / L / L));
}

TEST_CASE("a block on a slope stays below the angle of friction and slides with g (sin - mu cos) above it") {
  const double mu = 0.4, angle = std::atan(0.4);
  for (const double slope : {0.8 * angle, 1.5 * angle}) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(-slope, Vec3::UnitZ()).toRotationMatrix();  // down towards +x
    TetMesh block = block_of_tets(Vec3(0.2, 0.05, 0.2), 4, 1, 4);
    for (Vec3& v : block.vertices) v = R * (v + Vec3(0, 0.0265, 0));
    ModelBuilder builder;
    builder.add_solid("block", block, {"stable-neo-hookean", 1e6, 0.3, 1000});
    Collider plane;
    plane.friction = mu;
    plane.world_from_shape.linear() = R;
    Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {plane}, {2e-3, 1e-3, 0}),
                 {"implicit-euler", "auto", {1e-4, 60}, 6});
    const Vec3 down = R * Vec3::UnitX();
    const auto speed = [&] { return momentum(s).dot(down) / s.model().masses.sum(); };
    must_step(s, 1.0 / 240, 120);
    const double before = speed();
    must_step(s, 1.0 / 240, 120);
    CAPTURE(slope);
    if (slope < angle) {
      // It creeps at the share u of slip_speed at which the smoothed friction carries it: 2u - u^2 = 0.8, u = 0.55.
      CHECK(std::abs(speed()) < 1e-3);
    } else {
      const double expected = 9.81 * (std::sin(slope) - mu * std::cos(slope));
      CHECK((speed() - before) / 0.5 == doctest::Approx(expected).scale(0).epsilon(0.01));
    }
  }
}
