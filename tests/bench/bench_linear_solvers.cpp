// Every linear solver with every preconditioner on the first system of a step of a body of 10,206 tetrahedra, h = 1/60
// s: iterations, seconds (medians), error against Cholesky, memory. Prints; judges nothing.
//
//   build/release/tests/bench_linear_solvers [TOLERANCE [CELLS]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "sim/linear_solver.h"
#include "tests/sim/linear_systems.h"

using namespace softreel::sim;
using namespace softreel::tests;

namespace {

struct Run {
  LinearReport report;
  double analyse = 0, factorize = 0, solve = 0;  ///< medians [s]; what a first solve prepares counts as factorize
  double bytes = 0;
  Eigen::VectorXd x;
};

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

Run run(const System& s, const LinearSettings& settings, double tolerance) {
  Run result;
  const std::vector<double> targets = {tolerance * s.b.norm()};
  const LinearTargets wanted = s.targets(targets);
  const std::vector<double> met = {2 * s.b.norm()};  // by x = 0: such a solve only prepares
  std::vector<double> prepared, solved;
  const auto solver = make_linear_solver(settings);
  result.analyse = seconds_of([&] { solver->analyse(s.A); });
  double total = 0;
  for (int repeat = 0; repeat < 5 && total < 4; ++repeat) {
    const auto prepare = [&] { solver->solve(s.b, s.targets(met), result.x); };
    const double made = seconds_of([&] { solver->factorize(s.A); });
    const double first = seconds_of(prepare), again = seconds_of(prepare);
    prepared.push_back(made + std::max(0.0, first - again));
    solved.push_back(seconds_of([&] { result.report = solver->solve(s.b, wanted, result.x); }));
    total += made + first + again + solved.back();
  }
  result.factorize = median(prepared);
  result.solve = median(solved);
  result.bytes = static_cast<double>(solver->bytes());
  return result;
}

void print(const std::string& name, const std::string& with, const Run& r, const Eigen::VectorXd& reference) {
  std::printf("  %-17s %-20s %7ld %8.4f %8.4f %8.4f ", name.c_str(), with.c_str(), r.report.iterations, r.analyse,
              r.factorize, r.solve);
  if (r.report.ok)
    std::printf("%9.1e %8.2f\n", (r.x - reference).norm() / reference.norm(), r.bytes / 1e6);
  else
    std::printf("%9s %8.2f  %s\n", "-", r.bytes / 1e6, r.report.reason.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const double tolerance = argc > 1 ? std::atof(argv[1]) : 1e-8;
  const int cells = argc > 2 ? std::max(1, std::atoi(argv[2])) : 9;
  for (double young : {1e5, 1e7}) {
    const System s = real_system({7 * cells / 3, cells, cells}, young, 1.0 / 60);
    std::printf("block, %d vertices, Young %.0e, |r| <= %.0e |b|\n", s.A.rows(), young, tolerance);
    std::printf("  %-17s %-20s %7s %8s %8s %8s %9s %8s\n", "solver", "preconditioner", "it.", "analyse", "factor.",
                "solve", "rel.err.", "MB");
    const Eigen::VectorXd reference = run(s, "cholesky", tolerance).x;
    for (const MethodInfo& method : linear_solvers()) {
      LinearSettings settings(method.name);
      const bool takes = settings.method == "cg" || settings.method == "gmres" || settings.method == "steepest-descent";
      if (!takes) {
        print(settings.method, "", run(s, settings, tolerance), reference);
        continue;
      }
      for (const MethodInfo& preconditioner : preconditioners()) {
        settings.preconditioner = preconditioner.name;
        print(settings.method, settings.preconditioner, run(s, settings, tolerance), reference);
      }
    }
  }
  return 0;
}
