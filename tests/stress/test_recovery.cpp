// What comes back from collapsed, random and flattened states, and which materials claim to.
#include <cstdio>

#include "tests/sim/derivatives.h"
#include "tests/stress/bodies.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

constexpr int kSeeds = 5;
constexpr double kLength = 1;

/// What a material stands up to.
enum class Claim {
  kReturns,     ///< to the rest shape, from every state
  kStationary,  ///< an end where the forces balance; with nu near 0.5 there are other minima, tangled ones too
  kFinite,      ///< no more than numbers: linear and stvk do not feel an inversion
};

Claim claim(const std::string& material, double poisson) {
  if (material == "linear" || material == "stvk") return Claim::kFinite;
  if (material == "corotated") return Claim::kStationary;
  return material != "corotated-det" && poisson <= 0.4 ? Claim::kReturns : Claim::kStationary;
}

const char* const kStates[] = {"point with noise", "random in a box", "flattened"};

Eigen::VectorXd state(const Eigen::VectorXd& rest, int kind, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd x = rest;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double noise = uniform(random);
    if (kind == 0) x(i) = 1e-2 * kLength * noise;
    if (kind == 1) x(i) = 0.5 * kLength * noise;
    if (kind == 2 && i % 3 == 1) x(i) = 0;
    if (kind == 2) x(i) += 1e-3 * kLength * noise * (i % 3 == 1 ? 0 : 1);
  }
  return x;
}

struct Tally {
  int returned = 0, finite = 0, upright = 0, stationary = 0, runs = 0;
};

TetMesh cube() { return block_of_tets(Vec3::Constant(kLength), 3, 3, 3); }

Model body(const std::string& material, double poisson, int kind, unsigned seed) {
  ModelBuilder builder;
  builder.add_solid("cube", cube(), {material, 1e5, poisson, 1000});
  Model model = builder.finish(Vec3::Zero(), {}, {}, {});
  model.x0 = state(model.x0, kind, seed);
  return model;
}

Eigen::VectorXd rest_positions() {
  const TetMesh mesh = cube();
  Eigen::VectorXd rest(3 * static_cast<Eigen::Index>(mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    rest.segment<3>(3 * static_cast<Eigen::Index>(i)) = mesh.vertices[i];
  return rest;
}

void add(Tally& tally, bool converged, const Eigen::VectorXd& x) {
  ++tally.runs;
  tally.stationary += converged ? 1 : 0;
  if (!x.allFinite()) return;
  ++tally.finite;
  tally.upright += inverted(cube(), x) == 0 ? 1 : 0;
  tally.returned += rms_from_rest(x, rest_positions()) < 1e-4 * kLength ? 1 : 0;
}

void print(const std::string& material, double poisson, const char* from, const Tally& t) {
  std::printf("  %-20s nu %.2f  %-17s  returned %d/%d  stationary %d  no inverted tet %d  finite %d\n",
              material.c_str(), poisson, from, t.returned, t.runs, t.stationary, t.upright, t.finite);
}

}  // namespace

TEST_CASE("quasi-static recovery from collapsed, random and flattened states") {
  std::printf("quasi-static recovery, %d seeds, up to a rigid motion\n", kSeeds);
  for (const MethodInfo& method : solid_materials()) {
    const std::string material(method.name);
    // Without a volume term, or without a claim, Poisson's ratio changes nothing that is looked at.
    const bool all = solid_traits(material).volume_term && claim(material, 0.3) != Claim::kFinite;
    for (const double poisson : all ? std::vector{0.3, 0.4, 0.45, 0.49} : std::vector{0.3}) {
      for (int kind = 0; kind < 3; ++kind) {
        CAPTURE(material);
        CAPTURE(poisson);
        CAPTURE(std::string(kStates[kind]));
        Tally tally;
        for (unsigned seed = 1; seed <= kSeeds; ++seed) {
          // Near its pole, where an element is all but a line, the rotation of the corotated family magnifies rounding:
          // there forces are known to some 1e-9 of those at the start.
          Simulation s(body(material, poisson, kind, seed),
                       {"static", "cholesky", {1e-7, claim(material, poisson) == Claim::kFinite ? 60 : 1000}, 0});
          const bool converged = s.step(1).converged;
          add(tally, converged, s.state().x);
          if (claim(material, poisson) == Claim::kFinite || !converged) continue;
          // A minimum of its own, not a place where the solver gave up: no direction leads down. The six rigid modes of
          // a body whose forces balance to 1e-7 of those at the start are zero up to as much.
          const Eigen::MatrixXd H = dense_hessian(*s.model().potentials[0], s.state().x, Definiteness::kExact);
          const Eigen::VectorXd modes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues();
          CHECK(modes(0) > -1e-6 * modes.tail(1)(0));
        }
        print(material, poisson, kStates[kind], tally);
        CHECK(tally.finite == tally.runs);
        if (claim(material, poisson) == Claim::kReturns) CHECK(tally.returned == tally.runs);
        if (claim(material, poisson) != Claim::kFinite) CHECK(tally.stationary == tally.runs);
      }
    }
  }
}

TEST_CASE("the exact point is stationary, and the report says so") {
  Model model = body("stable-neo-hookean", 0.3, 0, 1);
  model.x0.setZero();
  Simulation s(std::move(model), {"static", "cholesky", {}, 0});
  const StepReport r = s.step(1);
  CHECK(r.converged);
  CHECK(r.stopped_by == "rounding");
  CHECK(r.newton_iterations == 0);
  CHECK(s.energies().elastic > 0);  // though it is no minimum
}

TEST_CASE("the same states released in motion come back finite and upright") {
  std::printf("released in motion, 2 s at steps of 1/60 s\n");
  for (const char* material : {"stable-neo-hookean", "corotated-volume", "corotated-det"}) {
    for (const double poisson : {0.3, 0.4}) {
      for (int kind = 0; kind < 3; ++kind) {
        Tally tally;
        for (unsigned seed = 1; seed <= kSeeds; ++seed) {
          Simulation s(body(material, poisson, kind, seed), {"implicit-euler", "cholesky", {1e-3, 60}, 6});
          bool converged = true;
          for (int i = 0; i < 120 && converged; ++i) converged = s.step(1.0 / 60).converged;
          add(tally, converged, s.state().x);
        }
        print(material, poisson, kStates[kind], tally);
        CAPTURE(std::string(material));
        CAPTURE(poisson);
        CAPTURE(std::string(kStates[kind]));
        CHECK(tally.finite == tally.runs);
        CHECK(tally.stationary == tally.runs);  // every step converged
        CHECK(tally.upright == tally.runs);
      }
    }
  }
}

TEST_CASE("a cube with one face held, stretched tenfold and released, is back at rest") {
  const TetMesh mesh = cube();
  for (const char* material : {"stable-neo-hookean", "corotated-volume", "corotated-det"}) {
    ModelBuilder builder;
    builder.add_solid("cube", mesh, {material, 1e5, 0.3, 1000});
    builder.add_pin(pin_where(mesh.vertices, [](const Vec3& p) { return p.x() < -0.499; }));
    Model model = builder.finish(Vec3::Zero(), {}, {}, {});
    const Eigen::VectorXd rest = model.x0;
    Simulation s(std::move(model), {"static", "cholesky", {1e-12, 500}, 0});
    State stretched{0, rest, Eigen::VectorXd::Zero(rest.size())};
    for (Eigen::Index i = 0; i < rest.size(); i += 3) stretched.x(i) = -0.5 + 10 * (rest(i) + 0.5);
    s.restore(stretched, s.memory());
    const StepReport r = s.step(1);
    REQUIRE_MESSAGE(r.converged, r.reason);
    std::printf("stretched tenfold, %s: %ld iterations, off rest by %.1e\n", material, r.newton_iterations,
                (s.state().x - rest).cwiseAbs().maxCoeff());
    CHECK((s.state().x - rest).cwiseAbs().maxCoeff() < 1e-8);
  }
}
