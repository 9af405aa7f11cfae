#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "app/forecast_warnings.h"
#include "sim/stiffness_scale.h"

namespace softreel::app {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Index in model.bodies of what an attachment calls "cloth.2": bodies stand in the order soft, cloth, springs.
size_t body_index(const assets::Scene& scene, const assets::BodyName& name) {
  const size_t dot = name.place.find('.');
  const std::string kind = name.place.substr(0, dot);
  const size_t before = kind == "soft"    ? 0
                        : kind == "cloth" ? scene.soft.size()
                                          : scene.soft.size() + scene.cloth.size();
  return before + std::stoul(name.place.substr(dot + 1)) - 1;
}

std::vector<double> slice(const Eigen::VectorXd& values, const sim::BodyRange& body) {
  const auto part = values.segment(body.first, body.count);
  return {part.begin(), part.end()};
}

}  // namespace

void warn_of_ratios(const assets::Scene& scene, const sim::Model& model, std::vector<std::string>& warnings) {
  // The condition number of a step's matrix is about the larger of the two ratios: CG on the way to 1e-4 takes
  // some (root of it) iterations, a thousand at this figure.
  constexpr double kMostRatio = 1e5;
  if (scene.attachments.empty()) return;
  const Eigen::VectorXd stiffness = sim::stiffness_scale(model.potentials, model.x0);
  for (const assets::Attach& attach : scene.attachments) {
    const sim::BodyRange& a = model.bodies[body_index(scene, attach.bodies[0])];
    const sim::BodyRange& b = model.bodies[body_index(scene, attach.bodies[1])];
    const auto warn = [&](const char* what, const char* unit, double of_a, double of_b, const char* then) {
      if (!(of_a > 0) || !(of_b > 0) || std::max(of_a / of_b, of_b / of_a) < kMostRatio) return;
      warnings.push_back(fmt::format(
          "attachment '{}' ties '{}' ({:.2g} {} a vertex) to '{}' ({:.2g} {}): {} that differ "
          "{:.1g}-fold {}",
          attach.name, a.name, of_a, unit, b.name, of_b, unit, what, std::max(of_a / of_b, of_b / of_a), then));
    };
    warn("masses", "kg", median(slice(model.masses, a)), median(slice(model.masses, b)),
         "make the light one follow without weight and slow down every iterative solver; solver.linear = \"cholesky\" "
         "does not mind");
    warn("stiffnesses", "N/m", median(slice(stiffness, a)), median(slice(stiffness, b)),
         "make the soft one a mere passenger and slow down every iterative solver; a pin, or softer materials, do "
         "better");
  }
}

}  // namespace softreel::app
