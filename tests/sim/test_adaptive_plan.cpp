// The search for the number of steps, on errors that are written down instead of simulated.
#include <cmath>
#include <functional>

#include "sim/adaptive_plan.h"
#include "tests/sim/support.h"

using namespace softreel::sim;

namespace {

using Verdict = AdaptivePlan::Verdict;

/// Runs a plan on a motion of `amplitude` targets whose error at frame f is error(steps per interval of the run, f).
struct Written {
  AdaptiveProblem problem;
  double amplitude = 1e3;
  std::function<double(double steps, int frame)> error;
  std::function<bool(double steps)> holds = [](double) { return true; };
  std::vector<double> local = {};  // of each interval; empty: all alike

  std::vector<AdaptiveRun> runs = {};  // that were asked for
  std::vector<std::vector<double>> found = {};

  AdaptiveFigures figures(const AdaptiveRun& run, std::vector<double>& errors) const {
    AdaptiveFigures figures;
    figures.path = 10 * amplitude;
    figures.amplitude = amplitude;
    const std::vector<int> frames = visited_frames(problem.intervals, run.stride);
    const double steps = double(run.total()) / problem.intervals;
    for (int f : frames) errors.push_back(error(steps, f));
    for (size_t way = 0; way + 1 < frames.size(); ++way)
      figures.local.push_back(local.empty() ? 1 : local[size_t(frames[way])]);
    for (size_t i = 0; i < found.size(); ++i) {
      const std::vector<int> theirs = visited_frames(problem.intervals, runs[i].stride);
      std::vector<double> apart;
      for (size_t f = 0; f < theirs.size(); ++f) apart.push_back(std::abs(found[i][f] - error(steps, theirs[f])));
      figures.differences.push_back(apart);
    }
    return figures;
  }

  AdaptivePlan search() {
    AdaptivePlan plan(problem);
    while (plan.verdict() == Verdict::kGoOn) {
      const AdaptiveRun run = plan.run();
      if (!holds(double(run.total()) / problem.intervals)) {
        plan.failed();
        continue;
      }
      std::vector<double> errors;
      const AdaptiveFigures seen = figures(run, errors);
      runs.push_back(run);
      found.push_back(errors);
      plan.held(seen);
    }
    return plan;
  }
};

}  // namespace

TEST_CASE("frames that a coarse run visits are among those of every finer one, first and last always") {
  CHECK(visited_frames(10, 4) == std::vector<int>{0, 4, 8, 10});
  CHECK(visited_frames(8, 4) == std::vector<int>{0, 4, 8});
  CHECK(visited_frames(1, 4) == std::vector<int>{0, 1});
}

TEST_CASE("an error that falls with the method's order is met, and the estimate is right") {
  for (int p : {1, 2, 4}) {
    for (double constant : {3.0, 40.0, 200.0}) {
      Written motion{{48, p, 0, 1e-3}, 1e3, [&](double n, int f) { return constant * f / 48 * std::pow(n, -p); }};
      const AdaptivePlan plan = motion.search();
      INFO("order " << p << ", error of one step per frame " << constant);
      REQUIRE(plan.verdict() == Verdict::kMet);
      const double true_error = motion.found.back().back();
      CHECK(true_error <= 1);
      CHECK(plan.largest_estimate() >= true_error);
      CHECK(plan.largest_estimate() <= 1.3 * true_error);
      CHECK(motion.runs.back().stride == 1);
      long before = 0;
      for (size_t i = 0; i + 1 < motion.runs.size(); ++i) before += motion.runs[i].total();
      if (constant == 200 && p == 1) CHECK(before < 0.4 * double(motion.runs.back().total()));
    }
  }
}

TEST_CASE("steps go where the local errors are, and the last two runs share their proportions") {
  Written motion{{40, 2, 0, 1e-3}, 1e3, [](double n, int f) { return 400.0 * f / 40 / (n * n); }};
  motion.local.assign(40, 1e-3);
  motion.local[20] = motion.local[21] = 1;
  const AdaptivePlan plan = motion.search();
  REQUIRE(plan.verdict() == Verdict::kMet);
  const std::vector<int>&last = motion.runs.back().steps, &before = motion.runs[motion.runs.size() - 2].steps;
  CHECK(last[20] >= 3 * last[5]);
  const double ratio = double(last[20]) / before[20];
  for (size_t i = 0; i < last.size(); ++i) CHECK(std::abs(last[i] - ratio * before[i]) <= ratio + 1);
}

TEST_CASE("a run that fails is done again with twice the steps, and an explicit method never takes fewer than hold") {
  Written motion{
      {30, 2, 6.3, 1e-3}, 1e3, [](double n, int) { return 900 / (n * n); }, [](double n) { return n >= 10; }};
  motion.local.assign(30, 1e-6);
  motion.local[3] = 1;
  const AdaptivePlan plan = motion.search();
  CHECK(plan.verdict() == Verdict::kMet);
  for (const AdaptiveRun& run : motion.runs) {
    CHECK(run.stride == 1);
    for (int n : run.steps) CHECK(n >= 7);
  }
}

TEST_CASE("runs that do not approach each other end the search without a promise") {
  // Twice the steps lead to another motion each time, as after an impact that is missed or hit.
  const auto error = [](double n, int f) { return f == 0 ? 0.0 : std::lround(std::log2(n)) % 2 == 0 ? 350.0 : -350.0; };
  Written motion{{32, 2, 0, 1e-3}, 1e3, error};
  const AdaptivePlan plan = motion.search();
  CHECK(plan.verdict() == Verdict::kNotResolved);
  CHECK(motion.runs.size() < 12);
  CHECK(motion.runs.back().total() <= 32 * 128);
}

TEST_CASE("the minimizer's tolerance follows the error that a run is to have, and the length of the motion") {
  Written motion{{48, 2, 0, 1e-3}, 1e4, [](double n, int f) { return 4000.0 * f / 48 / (n * n); }};
  motion.search();
  CHECK(motion.runs.front().tolerance == 1e-3);
  // A hundredth of the target over the path, which is ten amplitudes here.
  CHECK(motion.runs.back().tolerance == doctest::Approx(0.01 / 1e5));
  for (size_t i = 1; i < motion.runs.size(); ++i) CHECK(motion.runs[i].tolerance >= motion.runs.back().tolerance);
}

TEST_CASE("the recorder takes differences of order p + 1, which vanish on polynomials of degree p") {
  for (int p : {1, 2, 4}) {
    AdaptiveRecorder smooth(p, 0), kinked(p, 0);
    for (int f = 0; f < 12; ++f) {
      smooth.add(Eigen::VectorXd::Constant(1, std::pow(f, p) - 3 * f), {});
      kinked.add(Eigen::VectorXd::Constant(1, std::abs(f - 9)), {});
    }
    for (double l : smooth.figures().local) CHECK(l == 1);  // all alike
    const std::vector<double> local = kinked.figures().local;
    REQUIRE(local.size() == 11);
    CHECK(local[0] < 1e-9);
    CHECK(local[8] > 1);
    CHECK(kinked.figures().path == doctest::Approx(11));
    CHECK(kinked.figures().amplitude == doctest::Approx(9));
  }
}
