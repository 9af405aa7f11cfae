#include "app/run_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/forecast_text.h"
#include "app/stability_outcome.h"
#include "app/world.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

using sim::Vec3;

// Within a stable step the energy of the symplectic methods swings by less than this many times what is in motion: by
// 1/(1 - (h omega/2)^2), 10 at 95 % of the limit. Beyond it energy grows by such a factor every few steps.
constexpr double kFromNowhere = 20;
// Momentum that unsolved steps may lose or find: solves that go a thousandth of their way leave less than that.
constexpr double kMomentumLost = 0.1;

bool has_bodies(const assets::Scene& scene) {
  return !scene.soft.empty() || !scene.cloth.empty() || !scene.springs.empty();
}

std::string names_of_inverted(const assets::Scene& scene, const Shapes& shapes, const Eigen::VectorXd& x) {
  const std::vector<int> inverted = inverted_tets(shapes, x);
  std::string text;
  for (size_t i = 0; i < inverted.size(); ++i)
    if (inverted[i] > 0)
      text += fmt::format("{}{} of {} tetrahedra of '{}'", text.empty() ? "" : ", ", inverted[i],
                          shapes.soft[i].rest.tets.size(), scene.soft[i].name);
  return text.empty() ? "" : text + " had turned inside out by then; ";
}

}  // namespace

std::vector<int> inverted_tets(const Shapes& shapes, const Eigen::VectorXd& x) {
  std::vector<int> inverted;
  Eigen::Index first = 0;  // soft bodies come first
  for (const SolidShape& shape : shapes.soft) {
    const auto at = [&](int v) -> Vec3 { return x.segment<3>(3 * (first + v)); };
    inverted.push_back(
        static_cast<int>(std::count_if(shape.rest.tets.begin(), shape.rest.tets.end(), [&](const sim::Tet& t) {
          return !(sim::tet_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3])) > 0);
        })));
    first += static_cast<Eigen::Index>(shape.rest.vertices.size());
  }
  return inverted;
}

RunWatch::RunWatch(const assets::Scene& scene, const Shapes& shapes)
    : scene_(scene),
      shapes_(shapes),
      energy_is_kept_(has_bodies(scene) && !sim::is_implicit(scene.time.integrator) && !is_driven(scene)) {}

std::optional<std::string> RunWatch::look(CachedFrame& frame) {
  frame.figures.inverted = 0;
  for (const int n : inverted_tets(shapes_, frame.state.x)) frame.figures.inverted += n;
  if (const double off = frame.figures.momentum_drift.value_or(0); off > kMomentumLost)
    return fmt::format(
        "the total momentum is off by {:.0f} % of what is in motion, though nothing but gravity acts on the bodies: "
        "the steps are not solved far enough (solver.tolerance = {:g}; 1e-3 and less keep it)",
        100 * off, scene_.solver.tolerance);
  if (!energy_is_kept_) return std::nullopt;
  const sim::Energies& e = frame.figures.energies;
  const double in_motion = e.kinetic + e.elastic + e.contact, total = in_motion + e.gravity + e.dissipated;
  if (!start_) start_ = total;
  const double gained = total - *start_, before = in_motion_;
  in_motion_ = std::max(in_motion_, in_motion);
  if (!std::isfinite(total)) return "its energy is not finite";
  // What rounding makes of the energy of bodies that rest is no gain.
  if (before <= 1e-9 * std::abs(*start_) || gained <= kFromNowhere * before) return std::nullopt;
  return fmt::format("{:.3g} J came from nowhere, {:.2g} times all that was in motion before", gained, gained / before);
}

Cause likely_cause(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& last) {
  if (!has_bodies(scene) || last.state.x.size() == 0) return {};
  Cause cause;
  std::string& text = cause.text;
  sim::Model model = build_model(scene, shapes);
  const Eigen::Index n = model.masses.size();
  Eigen::Index fastest = 0;
  for (Eigen::Index i = 1; i < n; ++i)
    if (last.state.v.segment<3>(3 * i).squaredNorm() > last.state.v.segment<3>(3 * fastest).squaredNorm()) fastest = i;
  const Vec3 p = last.state.x.segment<3>(3 * fastest);
  for (const sim::BodyRange& body : model.bodies)
    if (fastest >= body.first && fastest < body.first + body.count)
      text += fmt::format("'{}' moved fastest before, {:.3g} m/s near ({:.3g}, {:.3g}, {:.3g}); ", body.name,
                          last.state.v.segment<3>(3 * fastest).norm(), p.x(), p.y(), p.z());
  text += names_of_inverted(scene, shapes, last.state.x);
  if (!has_step_limit(scene)) return cause;
  // As deformed as the bodies were: faster than at the start, most often.
  model.x0 = last.state.x;
  model.v0 = last.state.v;
  const Forecast f = forecast_step(scene, model);
  const bool touching = last.figures.energies.contact > 0;
  if (f.verdict == Verdict::kHolds || (f.verdict == Verdict::kHoldsApart && !touching)) return cause;
  text += "as it stood then, " + verdict_sentence(scene, f);
  cause.advises = true;
  return cause;
}

}  // namespace softreel::app
