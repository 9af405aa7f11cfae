#include "app/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assets/error.h"

namespace softreel::app {
namespace {

constexpr double kRounding = 1e-13;  // of the size

std::string error_text(const StudyRow& row, double size) {
  return fmt::format("error {:.2g} % ({:.2g} m, at most {:.2g} px)", 100 * row.errors->worst / size, row.errors->worst,
                     row.errors->largest_px);
}

std::string target_line(const std::vector<StudyRow>& rows, const StudyTarget& target, double size) {
  const StudyRow* row = fastest(rows, target, size);
  return fmt::format("fastest under {:<5} {}\n", target.text() + ":",
                     row ? fmt::format("{}: {:.3g} s, {}", row->label, row->wall, error_text(*row, size))
                         : std::string("none of these runs"));
}

std::string present_line(const std::vector<StudyRow>& rows, double size) {
  const auto now = std::find_if(rows.begin(), rows.end(), [](const StudyRow& r) { return r.present; });
  if (now == rows.end()) return {};
  std::string line = fmt::format("the scene now:       {}: ", now->label);
  if (!now->done()) return line + fmt::format("{}: {}\n", now->status(), now->failure->why);
  line += fmt::format("{:.3g} s, {}", now->wall, error_text(*now, size));
  const StudyRow* best = fastest(rows, {StudyTarget::Kind::kMetres, now->errors->worst}, size);
  if (best == &*now || !best) return line + "; nothing here is as good in less time\n";
  return line + fmt::format("; {} is as good {:.2g} times faster\n", best->label, now->wall / best->wall);
}

}  // namespace

std::optional<double> observed_order(const std::vector<StudyRow>& rows, const std::string& method, double floor,
                                     double size) {
  std::vector<std::pair<double, double>> points;  // log step, log error
  for (const StudyRow& r : rows)
    if (r.method == method && r.done() && r.errors->worst > std::max(10 * floor, kRounding * size) &&
        r.errors->worst < 0.1 * size)
      points.emplace_back(std::log(r.step), std::log(r.errors->worst));
  std::sort(points.begin(), points.end());
  points.resize(std::min<size_t>(points.size(), 3));
  if (points.size() < 2) return std::nullopt;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) {
    x += a / static_cast<double>(points.size());
    y += b / static_cast<double>(points.size());
  }
  for (const auto& [a, b] : points) {
    xx += (a - x) * (a - x);
    xy += (a - x) * (b - y);
  }
  if (!(xx > 0)) return std::nullopt;  // all of one step
  return xy / xx;
}

bool StudyTarget::met_by(const StudyRow& row, double size) const {
  if (!row.done()) return false;
  switch (kind) {
    case Kind::kFraction:
      return row.errors->worst <= value * size;
    case Kind::kPixels:
      return row.errors->largest_px <= value;
    case Kind::kMetres:
      return row.errors->worst <= value;
  }
  return false;
}

std::string StudyTarget::text() const {
  switch (kind) {
    case Kind::kFraction:
      return fmt::format("{:g} %", 100 * value);
    case Kind::kPixels:
      return fmt::format("{:g} px", value);
    case Kind::kMetres:
      return fmt::format("{:g} m", value);
  }
  return {};
}

StudyTarget parse_target(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  std::string unit(at, end);
  unit.erase(0, unit.find_first_not_of(' ') == std::string::npos ? 0 : unit.find_first_not_of(' '));
  if (error == std::errc() && value > 0 && std::isfinite(value)) {
    using Kind = StudyTarget::Kind;
    if (unit == "%") return {Kind::kFraction, value / 100};
    if (unit == "px") return {Kind::kPixels, value};
    if (unit == "m") return {Kind::kMetres, value};
    if (unit == "cm") return {Kind::kMetres, value / 100};
    if (unit == "mm") return {Kind::kMetres, value / 1000};
  }
  throw assets::UserError(assets::ErrorKind::kUsage,
                          fmt::format("--apply: found \"{}\", expected an error above 0 with its unit: 1% (of the "
                                      "scene's size), 0.5px, 1mm, 1cm or 0.01m",
                                      text));
}

const StudyRow* fastest(const std::vector<StudyRow>& rows, const StudyTarget& target, double size) {
  const StudyRow* best = nullptr;
  for (const StudyRow& r : rows)
    if (target.met_by(r, size) && (!best || r.wall < best->wall)) best = &r;
  return best;
}

std::string study_lines(const std::vector<StudyRow>& rows, double size) {
  return target_line(rows, {StudyTarget::Kind::kFraction, 0.01}, size) +
         target_line(rows, {StudyTarget::Kind::kPixels, 1}, size) + present_line(rows, size);
}

const StudyRow* best_row(const std::vector<StudyRow>& rows) {
  const StudyRow* best = nullptr;
  for (const StudyRow& r : rows)
    if (r.done() && (!best || r.errors->worst < best->errors->worst)) best = &r;
  return best;
}

const StudyRow* worst_row(const std::vector<StudyRow>& rows) {
  const StudyRow* worst = nullptr;
  for (const StudyRow& r : rows)
    if (r.done() && (!worst || r.errors->worst > worst->errors->worst)) worst = &r;
  return worst;
}

}  // namespace softreel::app
