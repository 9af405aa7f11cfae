// Seconds per step of the two benchmark bodies: a clamped block of 96,000 tetrahedra and a pinned cloth of 32,768
// triangles. Prints medians; judges nothing.
//
//   build/release/tests/bench_sim [STEPS]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

using namespace softreel::sim;

namespace {

void run(const char* what, Model model, const char* linear, int steps) {
  Simulation s(std::move(model), {"implicit-euler", linear, {}, 6});
  std::vector<double> seconds;
  StepReport total;
  double first = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const StepReport r = s.step(1.0 / 120);
    const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!r.converged) {
      std::printf("%-34s %-9s failed: %s\n", what, linear, r.reason.c_str());
      return;
    }
    if (i == 0) {
      first = t;  // with the symbolic work
      continue;
    }
    seconds.push_back(t);
    total.add(r);
  }
  std::sort(seconds.begin(), seconds.end());
  const double n = steps;
  std::printf("%-34s %-9s %7.3f %7.3f  %5.1f %7.1f   %6.3f %6.3f %6.3f  %.*s\n", what, linear, first,
              seconds[seconds.size() / 2], total.newton_iterations / n, total.linear_iterations / n,
              total.seconds.gradient / n, total.seconds.assemble / n, total.seconds.solve / n,
              static_cast<int>(total.solver.size()), total.solver.data());
  std::fflush(stdout);
}

Model block(double young) {
  const TetMesh mesh = block_of_tets(Vec3(1, 0.5, 0.5), 40, 20, 20);  // 96,000 tetrahedra, 18,081 vertices
  ModelBuilder builder;
  builder.add_solid("block", mesh, {"stable-neo-hookean", young, 0.4, 1000});
  Pin pin;
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i].x() < -0.499) pin.vertices.push_back(static_cast<int>(i));
  builder.add_pin(std::move(pin));
  return builder.finish(Vec3(0, -9.81, 0), {}, {}, {});
}

Model cloth() {
  const TriangleMesh mesh = grid_sheet(1, 1, 128, 128);  // 32,768 triangles
  ModelBuilder builder;
  builder.add_membrane("cloth", mesh, {"stvk", 1e5, 0.3, 1e-3, 1e-5, BendingModel::kAuto, 0.2});
  Pin pin;
  pin.vertices = {0, 128};
  builder.add_pin(std::move(pin));
  return builder.finish(Vec3(0, -9.81, 0), {}, {}, {});
}

}  // namespace

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  std::printf("step 1/120 s, tolerance 1e-3, %d steps after the first\n", steps);
  std::printf("%-34s %-9s %7s %7s  %5s %7s   %6s %6s %6s  %s\n", "", "linear", "first", "median", "newt.", "lin.it.",
              "grad", "assem", "solve", "chosen");
  for (const char* linear : {"auto", "cg", "cholesky"}) {
    run("block 96,000 tets, Young 1e5", block(1e5), linear, steps);
    run("block 96,000 tets, Young 1e7", block(1e7), linear, steps);
    run("cloth 32,768 triangles, 2 corners", cloth(), linear, steps);
  }
  return 0;
}
