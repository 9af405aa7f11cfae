#include "app/forecast_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/simulation.h"
#include "sim/stability.h"

namespace softreel::app {
namespace {

/// A step as people write it: 1/120 s.
std::string step_text(const assets::Scene& scene) {
  const double per_second = scene.time.fps * scene.time.substeps;
  return std::abs(per_second - std::round(per_second)) < 1e-9 * per_second ? fmt::format("1/{:.0f} s", per_second)
                                                                           : fmt::format("{:.3g} s", scene.time.step());
}

/// 41, 2, 1.73
std::string figure(double x) { return x >= 10 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x); }

/// How much a factor is whose logarithm is given, also where no double holds it.
std::string factor_text(double log_factor) {
  const double power = log_factor / std::numbers::ln10;
  return power < 4 ? fmt::format("{:.3g}", std::exp(log_factor)) : fmt::format("1e{:.0f}", power);
}

bool fixed_point(const assets::Scene& scene) { return sim::is_implicit(scene.time.integrator); }

std::string method_name(const assets::Scene& scene) {
  return fixed_point(scene) ? scene.time.integrator + " with solver.method = \"fixed-point\"" : scene.time.integrator;
}

std::string alternative(const assets::Scene& scene) {
  return fixed_point(scene) ? "solver.method = \"newton\"" : "time.integrator = \"implicit-euler\"";
}

void line(std::string& text, std::string_view what, const std::string& figures) {
  text += fmt::format("  {:<16} {}\n", what, figures);
}

std::string where(const sim::Model& model, const sim::ModePlace& place) {
  // A micrometre is nothing to look for.
  const Eigen::Vector3d p = (model.x0.segment<3>(3 * place.vertex) * 1e6).array().round() * 1e-6;
  return fmt::format("'{}' near ({:.3g}, {:.3g}, {:.3g})", model.bodies[static_cast<size_t>(place.body)].name,
                     p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
}

std::string h_omega_text(const StepForecast& f, double h) {
  if (!(f.largest_step > 0))
    return fmt::format("{}: no step holds, the penalty stiffens as the step shrinks (contact.stiffness fixes it)",
                       figure(h * f.omega));
  if (!std::isfinite(f.largest_step)) return fmt::format("{}, no limit", figure(h * f.omega));
  const double of_limit = h / f.largest_step;
  return fmt::format("{}, limit {}: {}", figure(h * f.omega), figure(f.largest_step * f.omega_at_limit),
                     of_limit > 1 ? fmt::format("the step is {} times too long", figure(of_limit))
                                  : fmt::format("{:.0f} % of the largest step", 100 * of_limit));
}

/// What a step of the method takes from a motion that nothing damps, per second.
std::string own_damping(const assets::Scene& scene) {
  std::string text;
  for (const double hertz : {1.0, 5.0, 15.0}) {
    const double h_omega = scene.time.step() * 2 * std::numbers::pi * hertz;
    const double kept = std::pow(sim::spectral_radius(scene.time.integrator, h_omega), 1 / scene.time.step());
    const double lost = 100 * (1 - kept);
    text += fmt::format("{}{} % at {:g} Hz", text.empty() ? "" : ", ",
                        lost > 99 ? "over 99" : fmt::format("{:.2g}", lost), hertz);
  }
  return text;
}

void add_damping(std::string& text, const assets::Scene& scene) {
  // Below a part in a thousand per second nobody sees it.
  constexpr double kVisible = 1e-3;
  const double h_omega = scene.time.step() * 2 * std::numbers::pi;
  if (std::pow(sim::spectral_radius(scene.time.integrator, h_omega), 1 / scene.time.step()) > 1 - kVisible) return;
  line(text, "artificial loss",
       fmt::format("of amplitude per second, by {} alone: {}", scene.time.integrator, own_damping(scene)));
  assets::Scene finer = scene;
  finer.time.substeps *= 4;
  line(text, "", fmt::format("with time.substeps = {}: {}; newmark: nothing", finer.time.substeps, own_damping(finer)));
}

}  // namespace

std::string verdict_sentence(const assets::Scene& scene, const Forecast& f) {
  const bool apart = f.verdict == Verdict::kHoldsApart;
  const StepForecast& worst = apart ? *f.touching : f.apart;
  const std::string limit = worst.largest_step > 0
                                ? fmt::format("limit {}", figure(worst.largest_step * worst.omega_at_limit))
                                : "no step holds there";
  std::string text = fmt::format("{} at h = {} {}: h omega = {}, {}", method_name(scene), step_text(scene),
                                 fixed_point(scene) ? (apart ? "diverges where a body touches a collider" : "diverges")
                                 : apart            ? "may become unstable where a body touches a collider"
                                                    : "is unstable",
                                 figure(f.h * worst.omega), limit);
  if (!fixed_point(scene)) text += fmt::format("; over the clip a motion grows {}-fold", factor_text(worst.log_growth));
  if (!(worst.largest_step > 0)) return text + "; use " + alternative(scene);
  text += f.substeps > 0 ? fmt::format("; use time.substeps = {}, or {}", f.substeps, alternative(scene))
                         : fmt::format("; no time.substeps that a scene may have holds: use {}", alternative(scene));
  return text;
}

std::string forecast_text(const assets::Scene& scene, const sim::Model& model, const Forecast& f) {
  std::string text = "stability\n";
  const StepForecast& worst = f.verdict == Verdict::kHoldsApart ? *f.touching : f.apart;
  if (f.verdict == Verdict::kHolds && !f.limited)
    line(text, "verdict", fmt::format("holds: {} has no limit on the step", scene.time.integrator));
  else if (f.verdict == Verdict::kHolds)
    line(text, "verdict",
         std::isfinite(f.largest_step())
             ? fmt::format("holds: {} at h = {}; steps {:.2g} times as long would hold, too", method_name(scene),
                           step_text(scene), f.largest_step() / f.h)
             : fmt::format("holds: {} has no limit here", method_name(scene)));
  else
    line(text, "verdict", verdict_sentence(scene, f));
  if (!(worst.omega > 0)) {
    line(text, "fastest motion", "none: nothing that can move is elastic");
    return text;
  }
  line(text, "fastest motion",
       fmt::format("{:.4g} rad/s ({:.3g} Hz) in {}, damping ratio {:.2g}", f.apart.omega,
                   f.apart.omega / (2 * std::numbers::pi), where(model, f.apart.place), f.apart.damping_ratio));
  line(text, "h omega", h_omega_text(f.apart, f.h));
  if (f.touching) line(text, "in contact", h_omega_text(*f.touching, f.h));
  if (f.limited && std::isfinite(f.largest_step()))
    line(text, "largest step",
         fmt::format("{:.3g} s{}", f.largest_step(),
                     f.substeps > 0
                         ? fmt::format("; time.substeps = {} leaves {:.0f} % to spare", f.substeps, 100 * kSpare)
                         : ""));
  // With so much to spare nothing is missing; else what a stretch would take.
  if (f.substeps > 0 && f.stretched * (1 - kSpare) > 1)
    line(text, "",
         fmt::format("time.substeps = {:.0f} would hold with all stretched by {:.0f} %",
                     std::ceil(f.substeps * (1 - kSpare) * f.stretched), 100 * (kStretch - 1)));
  if (!f.omega_of_body.empty()) {
    std::vector<size_t> order(f.omega_of_body.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return f.omega_of_body[a] > f.omega_of_body[b]; });
    constexpr size_t kMostNamed = 4;
    std::string bodies;
    for (size_t k = 0; k < std::min(order.size(), kMostNamed); ++k)
      bodies += fmt::format("{}{} {:.3g}", k > 0 ? ", " : "", model.bodies[order[k]].name, f.omega_of_body[order[k]]);
    if (order.size() > kMostNamed)
      bodies += fmt::format(", {} more down to {:.3g}", order.size() - kMostNamed, f.omega_of_body[order.back()]);
    line(text, "by body [rad/s]", bodies);
  }
  line(text, "based on",
       fmt::format("the bodies as they start; stretched by {:.0f} % they are {:.3g} times as fast",
                   100 * (kStretch - 1), f.stretched));
  add_damping(text, scene);
  return text;
}

}  // namespace softreel::app
