#include "app/stability_plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

namespace softreel::app {
namespace {

constexpr const char* kStyle = R"(set encoding utf8
set border 3 lc rgb "#555555" lw 1
set tics nomirror out scale 0.6 textcolor rgb "#333333"
set key outside right top Left reverse spacing 1.25 samplen 1.5 textcolor rgb "#222222"
)";

/// Okabe, Ito 2008, "Color universal design"; failures warm, successes cool.
const char* color_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kHeld:
      return "#0072b2";
    case Outcome::kDampedAway:
      return "#009e73";
    case Outcome::kDrifted:
      return "#f0e442";
    case Outcome::kBlewUp:
      return "#d55e00";
    case Outcome::kNotConverged:
      return "#cc79a7";
    case Outcome::kRefused:
      return "#444444";
    case Outcome::kNotRun:
      return "#dddddd";
  }
  return "#dddddd";
}

std::string quoted(const std::string& words) {
  std::string result = "\"";
  for (const char c : words)
    if (c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 32) result += c;
  return result + "\"";
}

/// Where an axis draws its values: to scale if they are numbers, else side by side.
struct Scale {
  bool logarithmic = false;
  std::vector<double> at, lo, hi;  // middle and bounds of each cell

  explicit Scale(const MapAxis& axis) {
    logarithmic = axis.numeric;
    for (size_t k = 0; k < axis.values.size(); ++k) {
      at.push_back(axis.numeric ? std::stod(axis.values[k]) : static_cast<double>(k));
      logarithmic = logarithmic && at.back() > 0;
    }
    const auto to = [&](double v) { return logarithmic ? std::log(v) : v; };
    const auto back = [&](double u) { return logarithmic ? std::exp(u) : u; };
    for (size_t k = 0; k < at.size(); ++k) {
      const double alone = at.size() == 1 ? 0.5 : 0;
      const double before = k > 0 ? to(at[k]) - to(at[k - 1]) : alone > 0 ? 1 : to(at[1]) - to(at[0]);
      const double after = k + 1 < at.size() ? to(at[k + 1]) - to(at[k]) : before;
      lo.push_back(back(to(at[k]) - before / 2));
      hi.push_back(back(to(at[k]) + after / 2));
    }
  }
};

std::string axis_script(const char* name, const MapAxis& axis, const Scale& scale) {
  std::string script = fmt::format("set {}label {} noenhanced textcolor rgb \"#222222\"\nset {}range [{}:{}]\n", name,
                                   quoted(axis.key), name, scale.lo.front(), scale.hi.back());
  if (scale.logarithmic) script += fmt::format("set logscale {}\n", name);
  if (axis.numeric) return script;
  script += fmt::format("set {}tics (", name);
  for (size_t k = 0; k < axis.values.size(); ++k)
    script += fmt::format("{}{} {}", k > 0 ? ", " : "", quoted(axis.values[k]), k);
  return script + ") noenhanced\n";
}

/// Where the forecast crosses its limit in each column, between two cells by interpolation of the ratio's logarithm.
std::string limit_points(const StabilityMap& map, const Scale& x, const Scale& y) {
  std::string points;
  for (size_t c = 0; c < x.at.size(); ++c)
    for (size_t r = 0; r + 1 < y.at.size(); ++r) {
      const double a = map.at(c, r).step_over_limit, b = map.at(c, r + 1).step_over_limit;
      if (!(a > 0) || !(b > 0) || (a <= 1) == (b <= 1)) continue;
      const double u = std::log(a) / (std::log(a) - std::log(b));
      const double at =
          y.logarithmic ? y.at[r] * std::pow(y.at[r + 1] / y.at[r], u) : y.at[r] + u * (y.at[r + 1] - y.at[r]);
      points += fmt::format("{:.8g} {:.8g}\n", x.at[c], at);
    }
  return points;
}

}  // namespace

StudyPlot stability_plot(const std::string& title, const StabilityMap& map) {
  const Scale x(map.x), y(map.y);
  std::string script = kStyle;
  script += "set title " + quoted(title) + " noenhanced\nset style fill solid 1 noborder\n";
  script += axis_script("x", map.x, x) + axis_script("y", map.y, y);
  std::set<Outcome> seen;
  for (const MapCell& cell : map.cells) seen.insert(cell.outcome);
  std::string plots;
  for (const Outcome outcome : seen) {
    script += fmt::format("$cells{} << EOD\n", static_cast<int>(outcome));
    for (size_t r = 0; r < y.at.size(); ++r)
      for (size_t c = 0; c < x.at.size(); ++c)
        if (map.at(c, r).outcome == outcome)
          script += fmt::format("{:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g}\n", x.at[c], y.at[r], x.lo[c], x.hi[c],
                                y.lo[r], y.hi[r]);
    script += "EOD\n";
    plots +=
        fmt::format("{}$cells{} using 1:2:3:4:5:6 with boxxyerror lc rgb \"{}\" title \"{}\"",
                    plots.empty() ? "" : ", ", static_cast<int>(outcome), color_of(outcome), outcome_name(outcome));
  }
  const std::string limit = map.x.numeric && map.y.numeric ? limit_points(map, x, y) : "";
  if (!limit.empty()) {
    script += "$limit << EOD\n" + limit + "EOD\n";
    plots +=
        ", $limit using 1:2 with lines lc rgb \"#ffffff\" lw 5 notitle, $limit using 1:2 with lines lc rgb "
        "\"#000000\" lw 2 title \"forecast limit\"";
  }
  return {"stability", script + "plot " + plots + "\n"};
}

}  // namespace softreel::app
