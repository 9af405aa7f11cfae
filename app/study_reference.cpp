#include "app/study_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/hashes.h"
#include "app/progress.h"
#include "app/study_closed_form.h"
#include "app/study_measures.h"
#include "assets/atomic_file.h"
#include "assets/content_hash.h"
#include "assets/error.h"
#include "assets/scene_reader.h"
#include "assets/state_file.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::UserError;
using Clock = std::chrono::steady_clock;

constexpr int kVersion = 1;        // raised when references come out different
constexpr double kEnough = 1e-11;  // error relative to the scene's size
constexpr double kTrusted = 1e-3;  // above that a second method is tried
constexpr int kFinest = 64;        // times the substeps of the sweep

struct Method {
  const char* integrator;
  int order;
};

/// One level of refinement.
struct Level {
  int substeps;
  std::vector<CachedFrame> frames;
  std::vector<Eigen::Matrix3Xd> points;
};

/// Levels of one method, each with twice the substeps of the one before, the coarsest that holds first.
struct Ladder {
  Method method{};
  std::vector<Level> levels;
  double floor = 0, order = 0;
  std::string failure;
  bool out_of_time = false;
};

double seconds_until(Clock::time_point end) { return std::chrono::duration<double>(end - Clock::now()).count(); }

double apart(const Level& a, const Level& b) { return position_errors(a.points, b.points, nullptr).worst; }

/// With levels h and h/2 the finer one's error is |x_h - x_h/2| / (2^p - 1). The order p is observed over three levels
/// and taken between 1, what friction and impacts leave of any method, and what the method declares.
void estimate(Ladder& ladder) {
  const size_t n = ladder.levels.size();
  if (n < 2) return;
  const double last = apart(ladder.levels[n - 1], ladder.levels[n - 2]);
  double order = 1;
  if (n >= 3 && last > 0) {
    const double before = apart(ladder.levels[n - 2], ladder.levels[n - 3]);
    ladder.order = std::log2(before / last);
    order = std::clamp(ladder.order, 1.0, static_cast<double>(ladder.method.order));
  }
  ladder.floor = last / (std::exp2(order) - 1);
}

bool drives_consistent_mass(const assets::Scene& scene) {
  const auto is = [](const assets::Body& body) {
    return body.mass == assets::MassModel::kConsistent &&
           std::any_of(body.pins.begin(), body.pins.end(), [](const assets::Pin& p) { return !p.motion.empty(); });
  };
  return std::any_of(scene.soft.begin(), scene.soft.end(), is) ||
         std::any_of(scene.cloth.begin(), scene.cloth.end(), is);
}

std::vector<Method> methods_for(const assets::Scene& scene) {
  if (scene.time.integrator == "static") return {{"static", 1}};
  if (drives_consistent_mass(scene)) return {{"bdf2", 2}};  // which explicit methods do not take
  return {{"rk4", 4}, {"bdf2", 2}};
}

/// Solved as far as rounding allows.
assets::Scene reference_scene(assets::Scene scene, const Method& method) {
  const assets::Solver defaults;
  scene.time.integrator = method.integrator;
  scene.solver = defaults;
  scene.solver.linear = "cholesky";
  scene.solver.tolerance = 1e-10;
  return scene;
}

class Climber {
 public:
  Climber(const StudyPoints& points, SharedShapes& shapes, double size)
      : points_(points), shapes_(shapes), size_(size) {}

  /// From `most` / 64 substeps on, so that a budget too small for `most` still gives something; ends above `most`,
  /// where no run of the sweep is its own reference.
  Ladder climb(const assets::Scene& base, const Method& method, int most, Clock::time_point end) {
    Ladder ladder;
    ladder.method = method;
    assets::Scene scene = reference_scene(base, method);
    const Shapes& shapes = shapes_.of(scene);
    const PointMap map(points_, shapes);
    double seconds = 0;
    const long finest = static_cast<long>(most) * kFinest;
    for (long substeps = (most + kFinest - 1) / kFinest; substeps <= finest; substeps *= 2) {
      // A level takes twice what the one before took.
      const size_t n = ladder.levels.size();
      if (n >= 2 && 2 * seconds > seconds_until(end)) break;
      if (n >= 3 && ladder.levels.back().substeps > most && ladder.floor < kEnough * size_) break;
      scene.time.substeps = static_cast<int>(substeps);
      TrialOptions options;
      options.seconds = seconds_until(end);
      const Clock::time_point begin = Clock::now();
      Trial trial = run_trial(scene, shapes, options);
      seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      if (trial.failure && trial.failure->end == TrialEnd::kRefused)
        throw UserError(ErrorKind::kUsage, base.file.string(), trial.failure->why);
      if (trial.failure) {
        ladder.failure = fmt::format("{}, {} substeps: {} (t = {:.4g} s)", method.integrator, substeps,
                                     trial.failure->why, trial.failure->time);
        ladder.out_of_time = trial.failure->end == TrialEnd::kBudget;
        if (ladder.out_of_time) break;
        ladder.levels.clear();  // what held with longer steps was luck
        continue;
      }
      Level level{static_cast<int>(substeps), std::move(trial.frames), {}};
      for (const CachedFrame& frame : level.frames) level.points.push_back(map.at(frame.state.x));
      ladder.levels.push_back(std::move(level));
      if (ladder.levels.size() > 3) ladder.levels.erase(ladder.levels.begin());  // no more are needed
      estimate(ladder);
    }
    return ladder;
  }

 private:
  const StudyPoints& points_;
  SharedShapes& shapes_;
  double size_;
};

/// What meshes that are halved once more still change is added to the floor as it is: near corners and contacts the
/// order in space is anybody's guess.
double mesh_floor(const StudyPoints& points, SharedShapes& shapes, const assets::Scene& coarser, const Ladder& ladder,
                  double seconds) {
  assets::Scene scene = reference_scene(coarser, ladder.method);
  scene.time.substeps = ladder.levels.back().substeps;
  TrialOptions options;
  options.seconds = seconds;
  const Shapes& own = shapes.of(scene);
  const Trial trial = run_trial(scene, own, options);
  if (trial.failure) return std::numeric_limits<double>::infinity();
  const PointMap map(points, own);
  std::vector<Eigen::Matrix3Xd> at;
  for (const CachedFrame& frame : trial.frames) at.push_back(map.at(frame.state.x));
  return position_errors(at, ladder.levels.back().points, nullptr).worst;
}

std::string text_of(const std::string& integrator, int substeps, double factor) {
  return fmt::format("{}, {} substeps{}", integrator, substeps,
                     factor == 1 ? "" : fmt::format(", {:g} times the resolution", factor));
}

double size_of(const Eigen::VectorXd& x) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(x.data(), 3, x.size() / 3);
  const double diagonal = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  return diagonal > 0 ? diagonal : 1;
}

std::string hash_of(const Sweep& sweep) {
  assets::ContentHasher hasher;
  const assets::Scene& s = sweep.scene;
  hasher.add(kVersion).add(simulation_hash(s)).add(s.time.frames()).add(sweep.most_substeps).add(sweep.finest);
  if (s.reference) {
    hasher.add(s.reference->body.place).add(s.reference->x).add(s.reference->y).add(s.reference->z);
  }
  return hasher.hex();
}

void save(const std::filesystem::path& file, const StudyReference& r, const Ladder& best) {
  assets::StateRecord record;
  for (size_t f = 0; f < r.frames.size(); ++f) {
    const Eigen::VectorXd& x = r.frames[f].state.x;
    record.arrays[fmt::format("x/{}", f + 1)] = {x.data(), x.data() + x.size()};
  }
  record.scalars = {{"floor", r.floor},
                    {"order", r.order},
                    {"substeps", best.levels.back().substeps},
                    {std::string("method/") + best.method.integrator, 1}};
  assets::make_folders(file.parent_path());
  assets::write_state(file, r.hash, record);
}

bool load(const std::filesystem::path& file, double factor, StudyReference& r) {
  const auto record = assets::read_state(file, r.hash);
  if (!record) return false;
  for (int f = 0; f < r.scene.time.frames(); ++f) {
    const auto x = record->arrays.find(fmt::format("x/{}", f + 1));
    if (x == record->arrays.end()) return false;
    CachedFrame frame;
    frame.state.t = f / r.scene.time.fps;
    frame.state.x = Eigen::Map<const Eigen::VectorXd>(x->second.data(), static_cast<Eigen::Index>(x->second.size()));
    r.frames.push_back(std::move(frame));
  }
  r.floor = record->scalars.at("floor");
  r.order = record->scalars.at("order");
  for (const auto& [name, value] : record->scalars)
    if (name.starts_with("method/"))
      r.what = text_of(name.substr(7), static_cast<int>(record->scalars.at("substeps")), factor);
  return true;
}

[[noreturn]] void give_up(const assets::Scene& scene, const std::vector<Ladder>& ladders, double seconds) {
  const bool time = std::any_of(ladders.begin(), ladders.end(), [](const Ladder& l) { return l.out_of_time; });
  std::string tried;
  for (const Ladder& l : ladders) tried += (tried.empty() ? "" : "; ") + l.failure;
  if (time)
    throw UserError(ErrorKind::kUsage,
                    fmt::format("--budget is too small for one run: two runs to measure against did not end in the "
                                "{:.3g} s that are theirs ({}). A larger budget, a shorter time.duration or a "
                                "[reference] in closed form help",
                                seconds, tried));
  throw UserError(ErrorKind::kSimulation, scene.file.string(),
                  "no run holds that the others could be measured against: " + tried);
}

}  // namespace

StudyReference make_reference(const SweepRequest& request, const Sweep& sweep, const StudyPoints& points,
                              SharedShapes& shapes, const std::filesystem::path& folder, double seconds, bool quiet) {
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  StudyReference r;
  r.hash = hash_of(sweep);
  r.scene = sweep.scene;
  r.size = size_of(ClipWorld(sweep.scene, shapes.of(sweep.scene)).frame({}).state.x);
  if (sweep.scene.reference) {
    r.what = "the closed form";
    evaluate_closed_form(points, shapes.of(sweep.scene), r);
    return r;
  }
  const bool meshes = !request.resolutions.empty();
  const double factor = meshes ? 2 * sweep.finest : 1;
  const auto at_resolution = [&](double f) {
    std::vector<std::string> overrides = request.overrides;
    for (std::string& o : resolution_overrides(sweep.scene, f)) overrides.push_back(std::move(o));
    return assets::read_scene(request.scene, overrides);
  };
  if (meshes) r.scene = at_resolution(factor);
  const std::filesystem::path file = folder / ("reference_" + r.hash + ".state");
  if (!load(file, factor, r)) {
    say(quiet, "a finer run to measure against comes first");
    Climber climber(points, shapes, r.size);
    std::vector<Ladder> ladders;
    Ladder* best = nullptr;
    const std::vector<Method> methods = methods_for(r.scene);
    for (const Method& method : methods) {
      if ((best && best->floor < kTrusted * r.size) || (!ladders.empty() && seconds_until(end) <= 0)) break;
      const size_t chosen = best ? static_cast<size_t>(best - ladders.data()) : 0;
      // The first method leaves half of the time to the next, which it may need.
      const bool last = method.integrator == methods.back().integrator;
      const Clock::time_point until = last ? end : Clock::now() + (end - Clock::now()) / 2;
      ladders.push_back(climber.climb(r.scene, method, sweep.most_substeps, until));
      if (best) best = &ladders[chosen];
      Ladder& l = ladders.back();
      if (l.levels.size() >= 2 && (!best || l.floor < best->floor)) best = &l;
    }
    if (!best) give_up(sweep.scene, ladders, seconds);
    r.frames = best->levels.back().frames;
    r.floor = best->floor;
    r.order = best->order;
    if (meshes) r.floor += mesh_floor(points, shapes, at_resolution(sweep.finest), *best, seconds_until(end));
    r.what = text_of(best->method.integrator, best->levels.back().substeps, factor);
    save(file, r, *best);
  }
  const PointMap map(points, shapes.of(r.scene));
  for (const CachedFrame& frame : r.frames) r.points.push_back(map.at(frame.state.x));
  return r;
}

}  // namespace softreel::app
