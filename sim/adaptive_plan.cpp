#include "sim/adaptive_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace softreel::sim {
namespace {

// A relative error of the forces, the same in all steps, moves the solution by about that part of its path; the forces
// that it is relative to are those of a body that went on undeformed, which are larger than those that turn it.
constexpr double kAlgebraicPart = 0.01;
constexpr double kTightestTolerance = 1e-10;
constexpr double kUnknownError = 0.1;  // of a second run, as a part of the path
// Of a first run: steps are at most so many frames long, and at least so many.
constexpr int kLongestStride = 4, kFewestSteps = 8;
// Densities that save less than this are not worth leaving equal steps.
constexpr double kWorthwhile = 1.3;
constexpr double kLeastDensity = 0.25;
// Two runs farther apart than this part of the motion say nothing about how far they are from the solution.
constexpr double kResolved = 0.3;
constexpr double kLeastGrowth = 1.1;   // from a run that was nearly good enough
constexpr double kUntriedRatio = 2.5;  // as largest_ratio, from two runs whose order nothing has shown
constexpr double kSafety = 1.1;        // estimates come out right to about so much
constexpr int kMostUnresolved = 8, kMostRuns = 20;
constexpr double kMostSteps = 1 << 20;  // of an interval

/// How far the last run but one may be from the last: r^p is about 8, 20 and 80. Less makes the runs before it dear,
/// more asks the expansion to hold over too wide a range.
double largest_ratio(int p) { return p == 1 ? 8 : p == 2 ? 4.5 : 3; }
/// Which part of the target the last run aims at. A prediction that falls short costs a further run, so the more the
/// error changes with the steps, the more is left free: a few percent of the steps in each case.
double aim(int p) { return p == 1 ? 0.9 : p == 2 ? 0.85 : 0.65; }

double largest(const std::vector<double>& v) { return v.empty() ? 0 : *std::max_element(v.begin(), v.end()); }
double total(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

}  // namespace

long AdaptiveRun::total() const { return std::accumulate(steps.begin(), steps.end(), 0L); }

std::vector<int> visited_frames(int intervals, int stride) {
  std::vector<int> frames;
  for (int f = 0; f < intervals; f += stride) frames.push_back(f);
  frames.push_back(intervals);
  return frames;
}

AdaptivePlan::AdaptivePlan(const AdaptiveProblem& problem)
    : problem_(problem),
      density_(static_cast<size_t>(problem.intervals), 1.0),
      local_(static_cast<size_t>(problem.intervals), 1.0) {
  double scale = std::max(1.0, std::ceil(problem.least * (1 - 1e-9)));
  while (scale > 1.0 / kLongestStride && scale * problem.intervals >= 2 * kFewestSteps && scale / 2 >= problem.least &&
         scale <= 1)
    scale /= 2;
  ask_for(density_, scale, 0);
}

AdaptiveRun AdaptivePlan::run_of(const Density& density, double scale) const {
  AdaptiveRun run;
  // Strides are powers of two: the frames of a coarse run are among those of every finer one.
  while (2 * run.stride * scale <= 1) run.stride *= 2;
  if (run.stride > 1) {
    run.steps.assign(visited_frames(problem_.intervals, run.stride).size() - 1, 1);
    return run;
  }
  const double least = std::max(std::ceil(problem_.least * (1 - 1e-9)), 1.0);
  for (double d : density)
    run.steps.push_back(static_cast<int>(std::clamp(std::ceil(scale * d * (1 - 1e-9)), least, kMostSteps)));
  return run;
}

AdaptivePlan::Density AdaptivePlan::per_interval(const AdaptiveRun& run) const {
  const std::vector<int> frames = visited_frames(problem_.intervals, run.stride);
  Density steps;
  for (size_t way = 0; way < run.steps.size(); ++way) {
    const int length = frames[way + 1] - frames[way];
    steps.insert(steps.end(), static_cast<size_t>(length), static_cast<double>(run.steps[way]) / length);
  }
  return steps;
}

/// Local errors add up: the sum of those of all steps, up to a factor.
double AdaptivePlan::model_error(const Density& steps, double order) const {
  double sum = 0;
  for (size_t i = 0; i < steps.size(); ++i) sum += local_[i] * std::pow(steps[i], -order);
  return sum;
}

double AdaptivePlan::scale_for(const Density& density, double error, double order) const {
  const auto too_few = [&](double scale) { return model_error(per_interval(run_of(density, scale)), order) > error; };
  double lo = 0, hi = 1;
  while (too_few(hi) && hi < kMostSteps) hi *= 2;
  while (hi - lo > 1e-3 * hi) {
    const double middle = 0.5 * (lo + hi);
    (too_few(middle) ? lo : hi) = middle;
  }
  return hi;
}

void AdaptivePlan::ask_for(const Density& density, double scale, double expected_error) {
  density_ = density;
  run_ = run_of(density, scale);
  scale_ = density == Density(density.size(), 1.0) ? per_interval(run_).front() : scale;
  run_.tolerance = path_ == 0 ? problem_.loosest_tolerance
                              : std::clamp(kAlgebraicPart * std::max(expected_error, 1.0) / path_, kTightestTolerance,
                                           problem_.loosest_tolerance);
}

void AdaptivePlan::failed() {
  if (++runs_ >= kMostRuns || scale_ >= kMostSteps)
    verdict_ = Verdict::kNotResolved;
  else
    ask_for(density_, 2 * scale_, largest_estimate());
}

void AdaptivePlan::held(const AdaptiveFigures& figures) {
  ++runs_;
  learn(figures);
  observed_order_ = problem_.order;
  if (done_.size() == 1) return ask_for(density_, 2 * scale_, kUnknownError * path_);
  judge(figures);
  if (verdict_ == Verdict::kGoOn) choose_next();
}

void AdaptivePlan::learn(const AdaptiveFigures& figures) {
  done_.push_back({run_.stride, per_interval(run_)});
  const double hardest = largest(figures.local);
  if (hardest > 0) {
    const std::vector<int> frames = visited_frames(problem_.intervals, run_.stride);
    for (size_t way = 0; way < figures.local.size(); ++way)
      for (int i = frames[way]; i < frames[way + 1]; ++i)
        local_[static_cast<size_t>(i)] = std::max(figures.local[way] / hardest, 1e-12);
  }
  path_ = figures.path;
}

void AdaptivePlan::judge(const AdaptiveFigures& figures) {
  const size_t k = done_.size() - 1;
  const int p = problem_.order;
  const auto ratio = [&](size_t i, size_t j) {
    return std::pow(model_error(done_[i].steps, p) / model_error(done_[j].steps, p), 1.0 / p);
  };
  const double apart = largest(figures.differences[k - 1]);
  double seen = p, shrunk = 1;
  if (k >= 2 && apart > 0) {
    // The last run stands for the solution when the two before it are judged.
    const double before = largest(figures.differences[k - 2]);
    if (before > 0) seen = std::log(before / apart) / std::log(ratio(k - 2, k - 1));
    shrunk = ratio(k - 2, k);
  }
  const bool resolved = apart <= kResolved * figures.amplitude && seen > 0.25 * p;
  unresolved_ = resolved ? 0 : unresolved_ + 1;
  // What the order lacks comes from the next term of the expansion, so it shrinks with the steps: from the geometric
  // middle of the two runs before to that of the last two by the root of the ratio of first and last. Fast modes that
  // the coarse runs do not resolve shrink later, so only the root of that is counted on.
  observed_order_ = p - (p - std::clamp(seen, 0.25 * p, static_cast<double>(p))) / std::pow(shrunk, 0.25);
  estimate_ = figures.differences[k - 1];
  // An error that is a visible part of the motion has begun to saturate.
  const double saturation = figures.amplitude > 0 ? 1 + apart / figures.amplitude : 1;
  const double factor = kSafety * saturation / (std::pow(ratio(k - 1, k), observed_order_) - 1);
  for (double& e : estimate_) e *= factor;
  if (largest_estimate() <= 1 && (resolved || apart <= 1))
    verdict_ = Verdict::kMet;
  else if (runs_ >= kMostRuns || unresolved_ >= kMostUnresolved || scale_ >= kMostSteps)
    verdict_ = Verdict::kNotResolved;
}

void AdaptivePlan::choose_next() {
  if (unresolved_ > 0) return ask_for(density_, 2 * scale_, largest_estimate() / 2);
  const int p = problem_.order;
  const Density& now = done_.back().steps;
  const double part = aim(p) / largest_estimate();
  const double goal =
      std::max(scale_for(density_, part * model_error(now, observed_order_), observed_order_), kLeastGrowth * scale_);
  const double most = done_.size() > 2 ? largest_ratio(p) : kUntriedRatio;
  if (goal <= most * scale_) return ask_for(density_, std::max(goal, 1.0), aim(p));
  // A run in between, as near to the last one as that has to be if all goes with the method's own order: from there the
  // rest is seen better than from here.
  Density density;
  for (double l : local_) density.push_back(std::max(kLeastDensity, std::pow(l, 1.0 / (p + 1))));
  const double error = part * model_error(now, p);
  const double equal = scale_for(density_, error, p), graded = scale_for(density, error, p);
  const bool better =
      total(per_interval(run_of(density_, equal))) > kWorthwhile * total(per_interval(run_of(density, graded)));
  const double next =
      better ? std::max(graded / largest_ratio(p), 1.0) : std::max(equal / largest_ratio(p), 2 * scale_);
  ask_for(better ? density : density_, next, std::pow((better ? graded : equal) / next, p));
}

double AdaptivePlan::largest_estimate() const { return largest(estimate_); }

std::vector<double> AdaptivePlan::estimate_of_frames() const {
  std::vector<double> all(static_cast<size_t>(problem_.intervals) + 1, 0.0);
  if (done_.size() < 2) return all;
  const std::vector<int> frames = visited_frames(problem_.intervals, done_[done_.size() - 2].stride);
  for (size_t way = 0; way + 1 < frames.size(); ++way)
    for (int f = frames[way] + 1; f <= frames[way + 1]; ++f)
      all[static_cast<size_t>(f)] =
          f == frames[way + 1] ? estimate_[way + 1] : std::max(estimate_[way], estimate_[way + 1]);
  return all;
}

}  // namespace softreel::sim
