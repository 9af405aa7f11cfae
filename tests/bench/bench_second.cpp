// One second of simulation, 60 steps, set-up of the first run included: clamped half-metre cubes and a cloth that hangs
// from two corners. Prints medians over the runs, per stage; judges nothing.
//
//   build/release/tests/bench_second [RUNS [PART OF A NAME [LINEAR SOLVER]]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

using namespace softreel::sim;

namespace {

constexpr int kSteps = 60;
const char* only = "";          // runs whose name has this in it
const char* instead = nullptr;  // of the linear solver that a run has

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// A cube of 0.5 m, held at one side; 6 tetrahedra a cell.
Model cube(int x, int y, int z, double young) {
  const TetMesh mesh = block_of_tets(Vec3::Constant(0.5), x, y, z);
  ModelBuilder builder;
  builder.add_solid("cube", mesh, {"stable-neo-hookean", young, 0.4, 1000});
  Pin pin;
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i].x() < -0.2499) pin.vertices.push_back(static_cast<int>(i));
  builder.add_pin(std::move(pin));
  return builder.finish(Vec3(0, -9.81, 0), {}, {}, {});
}

Model cloth(int cells) {
  ModelBuilder builder;
  builder.add_membrane("cloth", grid_sheet(1, 1, cells, cells),
                       {"stvk", 1e5, 0.3, 1e-3, 1e-5, BendingModel::kAuto, 0.2});
  Pin pin;
  pin.vertices = {0, cells};
  builder.add_pin(std::move(pin));
  return builder.finish(Vec3(0, -9.81, 0), {}, {}, {});
}

/// The lowest point at the end [m].
double run(const char* what, const std::function<Model()>& make, const char* linear, double tolerance, int runs) {
  if (!std::strstr(what, only)) return 0;
  if (instead) linear = instead;
  double lowest = 0;
  std::vector<double> seconds;
  StepReport total;
  double build = 0;
  for (int k = 0; k < runs; ++k) {
    const double start = now();
    SimulationSettings settings{"implicit-euler", linear, {tolerance, 60, 1e-4}, 6};
    Simulation s(make(), settings);
    build = now() - start;
    total = {};
    for (int i = 0; i < kSteps; ++i) {
      total.add(s.step(1.0 / kSteps));
      if (!total.converged) {
        std::printf("%-36s failed: %s\n", what, total.reason.c_str());
        return 0;
      }
    }
    seconds.push_back(now() - start);
    lowest = s.state().x(1);
    for (int i = 0; i < s.model().vertices(); ++i) lowest = std::min(lowest, s.state().x(3 * i + 1));
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%-36s %-9s %7.2f  %5.2f %5.2f %5.2f %5.2f %5.2f  %5.1f %8.1f  %+.5f  %.*s\n", what, linear,
              seconds[seconds.size() / 2], build, total.seconds.gradient, total.seconds.assemble, total.seconds.solve,
              total.seconds.other(), static_cast<double>(total.newton_iterations) / kSteps,
              static_cast<double>(total.linear_iterations) / kSteps, lowest, static_cast<int>(total.solver.size()),
              total.solver.data());
  std::fflush(stdout);
  return lowest;
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
  if (argc > 2) only = argv[2];
  if (argc > 3) instead = argv[3];
  std::printf("one second in %d steps, tolerance 1e-3, median of %d runs [s]; stages of the last run\n", kSteps, runs);
  std::printf("%-36s %-9s %7s  %5s %5s %5s %5s %5s  %5s %8s  %8s  %s\n", "", "linear", "in all", "build", "grad",
              "assem", "solve", "other", "newt.", "lin.it.", "lowest", "chosen");
  run(
      "cube, 96,000 tets, Young 1e5", [] { return cube(32, 25, 20, 1e5); }, "auto", 1e-3, runs);
  run(
      "cube, 264,000 tets, Young 1e5", [] { return cube(44, 40, 25, 1e5); }, "auto", 1e-3, runs);
  const auto stiff = [] { return cube(32, 25, 20, 1e7); };
  const double at_default = run("cube, 96,000 tets, Young 1e7", stiff, "auto", 1e-3, runs);
  const double exact = run("the same to 1e-8, direct", stiff, "cholesky", 1e-8, 1);
  std::printf("lowest point of the stiff cube off by %.3f %% of its way\n",
              100 * std::abs((at_default - exact) / (exact + 0.25)));
  run(
      "cloth, 8,192 triangles", [] { return cloth(64); }, "auto", 1e-3, runs);
  run(
      "cloth, 32,768 triangles", [] { return cloth(128); }, "auto", 1e-3, runs);
  return 0;
}
