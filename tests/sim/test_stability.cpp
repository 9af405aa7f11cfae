// Linear stability of the integrators, and that simulations obey it.
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "sim/grids.h"
#include "sim/stability.h"
#include "tests/sim/support.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// For the undamped oscillator (Hairer, Lubich, Wanner 2006; Hairer, Norsett, Wanner 1993).
const std::map<std::string_view, double> kLimits = {
    {"forward-euler", 0},
    {"heun", 0},
    {"midpoint", 0},
    {"rk4", 2 * std::numbers::sqrt2},
    {"symplectic-euler", 2},
    {"symplectic-euler-position", 2},
    {"verlet", 2},
    {"leapfrog", 2},
    {"implicit-euler", kInfinity},
    {"newmark", kInfinity},
    {"implicit-midpoint", kInfinity},
    {"bdf2", kInfinity},
};

/// The amplitude of the oscillator of h omega after so many steps, relative to that at the start.
double growth(const std::string& integrator, double h_omega, int steps) {
  TriangleMesh pair;
  pair.vertices = {Vec3(0, 0, 0), Vec3(1 + 1e-3, 0, 0)};
  ModelBuilder builder;
  builder.add_mass_spring("oscillator", pair, {{0, 1, 1.0, 1.0}}, 1, 0);
  builder.add_pin(pin_where(pair.vertices, [](const Vec3& p) { return p.x() == 0; }));
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.masses.setConstant(1);
  Simulation s(std::move(model), exact(integrator));
  double largest = 0;
  for (int i = 0; i < steps; ++i) {
    const StepReport r = s.step(h_omega);
    if (!r.converged) return kInfinity;
    largest = std::max(largest, std::abs(s.state().x(3) - 1) / 1e-3);
    if (largest > 1e2) return largest;
  }
  return largest;
}

}  // namespace

TEST_CASE("the stability limits of all integrators are those of theory") {
  for (const MethodInfo& method : integrators()) {
    if (method.order == 0) continue;
    CAPTURE(method.name);
    REQUIRE(kLimits.count(method.name) == 1);
    const double limit = kLimits.at(method.name);
    const double computed = stability_limit(method.name);
    if (limit > 0 && limit < kInfinity)
      CHECK(computed ==
            doctest::Approx(limit).scale(0).epsilon(1e-3));  // the growth of 1e-6 a step that counts as none
    else
      CHECK(computed == limit);
  }
}

TEST_CASE("simulations of an oscillator grow where theory says, within 2 % of the step") {
  for (const auto& [name, limit] : kLimits) {
    if (limit == 0 || limit == kInfinity) continue;
    CAPTURE(name);
    // Below the limit the invariant of the symplectic methods bounds the amplitude by 1/sqrt(1 - (h omega/2)^2) = 5;
    // above, 2 % make 1.22 a step for them, and a growth of 1.1 for rk4.
    CHECK(growth(std::string(name), 0.98 * limit, 1000) < 10);
    CHECK(growth(std::string(name), 1.02 * limit, 1000) > 100);
  }
}

TEST_CASE("spectral radii are those of the amplification factors") {
  for (const double w : {0.1, 0.7, 1.5, 10.0}) {
    CAPTURE(w);
    const double i = w * w;
    CHECK(spectral_radius("forward-euler", w) == doctest::Approx(std::sqrt(1 + i)));
    CHECK(spectral_radius("heun", w) == doctest::Approx(std::sqrt(1 + i * i / 4)));
    CHECK(spectral_radius("midpoint", w) == doctest::Approx(std::sqrt(1 + i * i / 4)));
    CHECK(spectral_radius("rk4", w) ==
          doctest::Approx(std::sqrt(std::pow(1 - i / 2 + i * i / 24, 2) + i * std::pow(1 - i / 6, 2))));
    CHECK(spectral_radius("implicit-euler", w) == doctest::Approx(1 / std::sqrt(1 + i)));
    CHECK(spectral_radius("newmark", w) == doctest::Approx(1));
    CHECK(spectral_radius("implicit-midpoint", w) == doctest::Approx(1));
    CHECK(spectral_radius("bdf2", w) < 1);
  }
  // Damping shortens the stable step of the symplectic methods (velocity taken at the start): they are not better off.
  CHECK(spectral_radius("symplectic-euler", 1.9, 0.2) > 1);
  CHECK(spectral_radius("rk4", 2.7, 0.1) < 1);
}
