// One second of a cloth of 1 m that falls onto a fixed sphere (radius 0.25 m, from 5 cm above it): with itself and with
// the sphere, friction 0.3, contact distance 2 mm, 60 steps. Prints seconds by stage, iterations and crossings; judges
// nothing.
//
// Before that the broad phase alone, from ten thousand triangles to a million.
//
//   build/release/tests/bench_contact [CELLS ...] [v]      only the cloths of these sizes; v: step by step
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "assets/crossing_pairs.h"
#include "sim/contact/surface_contact.h"
#include "sim/grids.h"
#include "sim/model_builder.h"
#include "sim/simulation.h"

using namespace softreel;
using namespace softreel::sim;

namespace {

constexpr int kSteps = 60;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void drape(int cells, bool self, bool verbose) {
  const double start = now();
  TriangleMesh sheet = grid_sheet(1, 1, cells, cells);
  for (Vec3& v : sheet.vertices) v.y() = 0.3;
  ModelBuilder builder;
  const BodyRange body = builder.add_membrane("cloth", sheet, {"stvk", 1e5, 0.3, 1e-3, 1e-5, BendingModel::kAuto, 0.2});
  if (self) {
    SurfaceInput surface{"cloth", body.first, sheet.vertices, sheet.triangles, {}, 0, 0.3, true, true};
    builder.set_surfaces({surface}, {});
  }
  Collider ball;
  ball.shape = SphereShape{0.25};
  ball.friction = 0.3;
  ContactSettings contact;
  Simulation s(builder.finish(Vec3(0, -9.81, 0), {}, {ball}, contact), {});
  StepReport total;
  size_t crossings = 0;
  long most_active = 0, most_candidates = 0;
  for (int i = 0; i < kSteps && total.converged; ++i) {
    const StepReport r = s.step(1.0 / kSteps);
    total.add(r);
    TriangleMesh now_at = sheet;
    for (int v = 0; v < body.count; ++v) now_at.vertices[static_cast<size_t>(v)] = s.state().x.segment<3>(3 * v);
    SurfaceContactReport c;
    if (self) c = s.model().surfaces->report(s.state().x);
    most_active = std::max(most_active, c.active);
    most_candidates = std::max(most_candidates, c.candidates);
    if (verbose)
      std::printf(
          "%3d  newton %3ld linear %5ld retries %ld stiffened %ld  searches %ld candidates %6ld active %5ld gap %.2e  "
          "%.2f s\n",
          i + 1, r.newton_iterations, r.linear_iterations, r.retries, r.stiffenings, c.searches, c.candidates, c.active,
          c.smallest_gap, r.seconds.total);
    if (i % 10 == 9) crossings += assets::crossing_pairs(now_at, 1000).size();
  }
  if (!total.converged) std::printf("failed: %s\n", total.reason.c_str());
  std::printf(
      "%4d x %-4d self %d  %7.2f s: gradient %.2f assemble %.2f solve %.2f contact %.2f other %.2f;"
      " a step: newton %.1f linear %.0f; retries %ld stiffened %ld; candidates %ld active %ld; crossings %zu; total "
      "%.2f\n",
      cells, cells, self, total.seconds.total, total.seconds.gradient, total.seconds.assemble, total.seconds.solve,
      total.seconds.contact, total.seconds.other(), static_cast<double>(total.newton_iterations) / kSteps,
      static_cast<double>(total.linear_iterations) / kSteps, total.retries, total.stiffenings, most_candidates,
      most_active, crossings, now() - start);
  std::fflush(stdout);
}

/// Searching for candidates on a crumpled sheet that moves by a millimetre, and what they take.
void broad_phase(int cells) {
  SurfaceInput input{"sheet", 0, {}, {}, {}, 0, 0, true, true};
  const TriangleMesh sheet = grid_sheet(1, 1, cells, cells);
  input.vertices = sheet.vertices;
  input.triangles = sheet.triangles;
  const ContactSurfaces surfaces({input}, {});
  const double edge = 1.0 / cells;
  ContactCandidates candidates(surfaces, 0.1 * edge);
  std::vector<Vec3> x = surfaces.rest, move(x.size());
  for (size_t v = 0; v < x.size(); ++v) {  // folds of ten edges
    x[v].y() = 3 * edge * std::sin(x[v].x() / (10 * edge) * 6.28);
    move[v] = 0.1 * edge * Vec3(std::sin(50 * x[v].z()), 1, 0);
  }
  std::vector<double> seconds;
  for (int k = 0; k < 5; ++k) {
    const double start = now();
    candidates.begin(x, move);
    seconds.push_back(now() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("broad phase: %8zu triangles %8.1f ms %6.0f ns a triangle; %zu candidates of %zu bytes\n",
              sheet.triangles.size(), 1e3 * seconds[2], 1e9 * seconds[2] / static_cast<double>(sheet.triangles.size()),
              candidates.count(), sizeof(Candidate));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  bool verbose = false;
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] == 'v')
      verbose = true;
    else
      sizes.push_back(std::atoi(argv[i]));
  }
  if (sizes.empty()) {
    sizes = {32, 64, 128};
    for (const int cells : {71, 224, 707}) broad_phase(cells);  // 10 thousand, 100 thousand, a million triangles
  }
  for (const int cells : sizes)
    for (const bool self : {false, true}) drape(cells, self, verbose);
}
