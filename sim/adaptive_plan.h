#pragma once
// How many steps each interval between two frames takes, so that the error of the whole clip stays below a target.
//
// A controller of local errors (Hairer, Norsett, Wanner 1993, section II.4; Soderlind 2003) promises nothing about the
// error of the trajectory, which is what accumulates and is transported (Shampine 2005). So the two are kept apart:
//   - where the steps go is decided by local errors: every step is to contribute the same (equidistribution), which
//     puts steps in proportion to the (p+1)-th root of an interval's local error;
//   - how many there are in all is decided by the error of the whole trajectory, measured by global extrapolation
//     (Skeel 1986; Hairer, Norsett, Wanner 1993, section II.8): the clip is run with few steps, with more, and the
//     difference of two runs whose steps are in the ratio r is r^p - 1 times the error of the finer one. On steps that
//     follow one density the error has an expansion in powers of the scale, as on equal steps, so the last run shares
//     its density with the one that it is compared with.
// Steps of one interval are equal, so frames are hit exactly, and methods with memory start anew at most once a frame.
// Runs before the last are coarse, some with steps over several frames: together they take a fraction of its steps.
#include <vector>

#include "sim/adaptive_figures.h"

namespace softreel::sim {

struct AdaptiveProblem {
  int intervals = 1;                ///< between frames, >= 1
  int order = 1;                    ///< of the integrator, >= 1
  double least = 0;                 ///< steps per interval that the scene asks for, or that an explicit method needs to
                                    ///< be stable; below 1: first steps may be several frames long
  double loosest_tolerance = 1e-3;  ///< of the minimizer of an implicit step, relative (MinimizerSettings)
};

/// One run of the clip. It visits every `stride`-th frame, the first and the last.
struct AdaptiveRun {
  int stride = 1;
  std::vector<int> steps;  ///< of each way from one visited frame to the next
  double tolerance = 0;    ///< of the minimizer, tied to the error that the run is expected to have

  long total() const;
};

/// The frames that are visited, from 0.
std::vector<int> visited_frames(int intervals, int stride);

/// Runs are asked for one by one. What it decides depends on the figures alone, so an interrupted search goes on where
/// it was once it is told again what the finished runs have shown.
class AdaptivePlan {
 public:
  enum class Verdict {
    kGoOn,        ///< `run` is to be done
    kMet,         ///< the last run is the answer
    kNotResolved  ///< finer runs do not come closer to each other (impacts, chaos): the last one is the finest there is
  };

  explicit AdaptivePlan(const AdaptiveProblem& problem);

  Verdict verdict() const { return verdict_; }
  const AdaptiveRun& run() const { return run_; }
  /// The run held. `figures.differences`: to all runs that held before it, in their order.
  void held(const AdaptiveFigures& figures);
  /// The run blew up or did not converge: the next one has twice the steps.
  void failed();

  /// Error of the last run that held, for each frame that the run before it visited, in units of the target.
  const std::vector<double>& estimate() const { return estimate_; }
  double largest_estimate() const;
  /// Of `estimate`, for every frame: between two visited frames the larger of the two.
  std::vector<double> estimate_of_frames() const;
  /// Order at which runs were seen to approach each other, at most the method's own.
  double observed_order() const { return observed_order_; }

 private:
  using Density = std::vector<double>;  // steps per interval, relative
  struct Done {
    int stride = 1;
    Density steps;  // per interval
  };

  AdaptiveRun run_of(const Density& density, double scale) const;
  Density per_interval(const AdaptiveRun& run) const;
  double model_error(const Density& steps, double order) const;
  double scale_for(const Density& density, double error, double order) const;
  void learn(const AdaptiveFigures& figures);
  void judge(const AdaptiveFigures& figures);
  void choose_next();
  void ask_for(const Density& density, double scale, double expected_error);

  AdaptiveProblem problem_;
  Verdict verdict_ = Verdict::kGoOn;
  AdaptiveRun run_;
  Density density_, local_;
  double scale_ = 1;  // steps per interval where the density is 1
  double path_ = 0;   // of the last run that held
  std::vector<Done> done_;
  std::vector<double> estimate_;
  double observed_order_ = 0;
  int runs_ = 0, unresolved_ = 0;
};

}  // namespace softreel::sim
