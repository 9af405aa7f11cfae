#include "app/study_plot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <system_error>

#include "app/external_program.h"
#include "app/interrupt.h"
#include "app/study_summary.h"
#include "assets/error.h"

namespace softreel::app {
namespace {

// Okabe, Ito 2008, "Color universal design": told apart with every kind of colour vision. Yellow is too pale for lines.
constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#444444"};
constexpr std::array kDashes = {"1", "2", "4", "3", "5"};
constexpr std::array kMarks = {7, 5, 9, 11, 13, 6, 4};  // filled circle, square, triangles, rhombus; open ones

constexpr const char* kStyle = R"(set encoding utf8
set border 3 lc rgb "#555555" lw 1
set tics nomirror out scale 0.6 textcolor rgb "#333333"
set grid xtics ytics lc rgb "#dddddd" lw 0.6 dt 1
set key outside right top Left reverse spacing 1.25 samplen 2.4 width -6 textcolor rgb "#222222"
set xlabel textcolor rgb "#222222"
set ylabel textcolor rgb "#222222"
)";

/// Text between double quotes in a script.
std::string text(const std::string& words) {
  std::string result = "\"";
  for (const char c : words)
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) >= 32)
      result += c;
  return result + "\"";
}

std::vector<std::string> methods_of(const std::vector<StudyRow>& rows) {
  std::vector<std::string> methods;
  for (const StudyRow& r : rows)
    if (std::find(methods.begin(), methods.end(), r.method) == methods.end()) methods.push_back(r.method);
  return methods;
}

/// Colour and mark by integrator, dashes by what else differs.
std::string style_of(const std::vector<StudyRow>& rows, const std::string& method) {
  std::vector<std::string> integrators, siblings;
  std::string integrator;
  for (const StudyRow& r : rows)
    if (r.method == method) integrator = r.integrator;
  for (const StudyRow& r : rows) {
    if (std::find(integrators.begin(), integrators.end(), r.integrator) == integrators.end())
      integrators.push_back(r.integrator);
    if (r.integrator == integrator && std::find(siblings.begin(), siblings.end(), r.method) == siblings.end())
      siblings.push_back(r.method);
  }
  const auto place = [](const auto& list, const std::string& what) {
    return static_cast<size_t>(std::find(list.begin(), list.end(), what) - list.begin());
  };
  const size_t color = place(integrators, integrator), dash = place(siblings, method);
  return fmt::format("lc rgb \"{}\" dt {} pt {} ps 0.75 lw 1.8", kColors[color % kColors.size()],
                     kDashes[dash % kDashes.size()], kMarks[color % kMarks.size()]);
}

struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = 0;
  void add(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

std::string range(const char* axis, double lo, double hi) { return fmt::format("set {}range [{:.6g}:{:.6g}]\n", axis, lo, hi); }

}  // namespace

StudyPlot error_plot(const std::string& title, const std::vector<StudyRow>& rows, const StudyReference& reference) {
  Bounds x, y;
  for (const StudyRow& r : rows) {
    if (r.run) x.add(r.wall);
    if (r.done()) y.add(r.errors->worst);
  }
  if (!(x.hi > 0)) x.lo = x.hi = 1;
  if (!(y.hi > 0)) y.lo = y.hi = reference.size;
  const double floor = reference.floor;
  // A floor far below everything would squeeze the rest: it is then drawn at the bottom edge and says what it is.
  const double bottom = std::pow(10, std::floor(std::log10(floor > 1e-3 * y.lo && floor < y.lo ? floor / 1.5 : y.lo / 1.5)));
  const double top = std::pow(10, std::ceil(std::log10(y.hi * 1.5))), failed = top * 0.75;
  const double left = x.lo / 1.6, right = x.hi * 1.6;
  std::string script = kStyle;
  script += "set title " + text(title) + " noenhanced textcolor rgb \"#111111\"\n";
  script += "set logscale xy\nset format x \"%h\"\nset format y \"10^{%L}\"\n";
  script += "set xlabel \"seconds of simulation (wall, median)\"\n";
  script += "set ylabel \"position error: largest RMS of a frame [m]\"\n";
  script += range("x", left, right) + range("y", bottom, top);
  for (const double percent : {1.0, 0.01}) {
    const double level = percent / 100 * reference.size;
    if (level < bottom || level > top) continue;
    script += fmt::format("set arrow from graph 0, first {0:.6g} to graph 1, first {0:.6g} nohead lc rgb \"#bbbbbb\" lw 1 dt 3 back\n",
                          level);
    script += fmt::format("set label \"{0:g} % of the size\" at graph 0.995, first {1:.6g} right offset 0, 0.45 font \",9\" "
                          "textcolor rgb \"#888888\"\n",
                          percent, level);
  }
  if (floor > bottom && floor < top) {
    script += fmt::format("set object rectangle from graph 0, graph 0 to graph 1, first {:.6g} fc rgb \"#eeeeee\" fs "
                          "solid noborder behind\n", floor);
    script += fmt::format("set label \"below: the reference's own error\" at graph 0.01, first {:.6g} left offset 0, -0.6 "
                          "font \",9\" textcolor rgb \"#777777\"\n", floor);
  }
  std::string data, plots;
  size_t block = 0;
  const auto add = [&](const std::string& lines, const std::string& how) {
    data += fmt::format("$d{} << END\n{}END\n", block, lines);
    plots += fmt::format("{}$d{} {}", plots.empty() ? "plot " : ", \\\n  ", block, how);
    ++block;
  };
  bool any_failure = false, any_present = false;
  for (const std::string& method : methods_of(rows)) {
    std::vector<const StudyRow*> line;
    for (const StudyRow& r : rows)
      if (r.method == method && r.done() && r.errors->worst > 0 && r.wall > 0) line.push_back(&r);
    std::sort(line.begin(), line.end(), [](const StudyRow* a, const StudyRow* b) { return a->step > b->step; });
    if (line.empty()) continue;
    std::string points;
    for (const StudyRow* r : line) points += fmt::format("{:.6g} {:.6g}\n", r->wall, r->errors->worst);
    const auto order = observed_order(rows, method, floor, reference.size);
    const std::string name = order ? fmt::format("{}: order {:.2f}", method, *order) : method;
    add(points, fmt::format("with linespoints {} title {} noenhanced", style_of(rows, method), text(name)));
  }
  for (const std::string& method : methods_of(rows)) {
    std::string points;
    for (const StudyRow& r : rows)
      if (r.method == method && r.run && r.failure && r.wall > 0)
        points += fmt::format("{:.6g} {:.6g}\n", std::max(r.wall, left * 1.05), failed);
    if (points.empty()) continue;
    add(points, fmt::format("with points {} pt 2 ps 1.0 notitle", style_of(rows, method).substr(0, 16)));
    any_failure = true;
  }
  for (const StudyRow& r : rows)
    if (r.present && r.done() && r.errors->worst > 0) {
      add(fmt::format("{:.6g} {:.6g}\n", r.wall, r.errors->worst),
          "with points pt 6 ps 2.2 lw 1.6 lc rgb \"#111111\" title \"the scene now\"");
      any_present = true;
    }
  if (any_failure) plots += ", \\\n  NaN with points pt 2 ps 1.0 lc rgb \"#555555\" title \"failed (at the top)\"";
  if (plots.empty()) plots = "plot NaN notitle";
  static_cast<void>(any_present);
  return {"error", script + data + plots + "\n"};
}

StudyPlot energy_plot(const std::string& title, const std::vector<StudyRow>& rows, const assets::Scene& scene) {
  std::string data, plots;
  std::vector<std::string> integrators;
  for (const StudyRow& r : rows)
    if (r.done() && r.drifts.energy && std::find(integrators.begin(), integrators.end(), r.integrator) == integrators.end())
      integrators.push_back(r.integrator);
  for (size_t i = 0; i < integrators.size(); ++i) {
    const StudyRow* chosen = nullptr;
    const auto off = [&](const StudyRow& r) { return std::abs(std::log(r.step / scene.time.step())); };
    for (const StudyRow& r : rows)
      if (r.integrator == integrators[i] && r.done() && (!chosen || off(r) < off(*chosen))) chosen = &r;
    data += fmt::format("$d{} << END\n", i);
    for (size_t f = 0; f < chosen->energy.size(); ++f)
      data += fmt::format("{:.6g} {:.6g}\n", static_cast<double>(f) / scene.time.fps, chosen->energy[f]);
    data += "END\n";
    plots += fmt::format("{}$d{} with lines {} title {} noenhanced", plots.empty() ? "plot " : ", \\\n  ", i,
                         style_of(rows, chosen->method), text(chosen->label));
  }
  if (plots.empty()) return {"energy", ""};
  std::string script = kStyle;
  script += "set title " + text(title) + " noenhanced textcolor rgb \"#111111\"\n";
  script += "set xlabel \"time in the clip [s]\"\nset ylabel \"change of the total energy [J]\"\nset format y \"%.3g\"\n";
  script += fmt::format("set xrange [0:{:.6g}]\n", (scene.time.frames() - 1) / scene.time.fps);
  return {"energy", script + data + plots + "\n"};
}

bool draw_plot(const StudyPlot& plot, const std::filesystem::path& folder) {
  if (find_program("gnuplot").empty()) return false;
  for (const auto& [ending, terminal] :
       {std::pair{".svg", "svg size 1000,560 dynamic font \"DejaVu Sans,12\" background \"#ffffff\""},
        std::pair{".png", "pngcairo size 1500,840 font \"DejaVu Sans,12\" fontscale 1.4 linewidth 1.6 pointscale 1.5 background \"#ffffff\""}}) {
    const std::filesystem::path file = folder / (plot.name + ending);
    const std::filesystem::path temporary = folder / fmt::format(".{}.{}{}", plot.name, getpid(), ending);
    struct Remove {
      const std::filesystem::path& file;
      ~Remove() {
        std::error_code ignored;
        std::filesystem::remove(file, ignored);
      }
    } const remove{temporary};
    PipeTo gnuplot({"gnuplot"}, stop_if_interrupted);
    const std::string script = fmt::format("set terminal {}\nset output {}\n{}", terminal, text(temporary.string()), plot.script);
    const bool reading = gnuplot.write(script.data(), script.size());
    const int code = gnuplot.finish();
    std::error_code error;
    if (code != 0 || !reading || !std::filesystem::exists(temporary, error))
      throw assets::UserError(assets::ErrorKind::kOutput, file.string(),
                              fmt::format("gnuplot could not draw it (exit code {}): {}", code, gnuplot.complaint()));
    std::filesystem::rename(temporary, file, error);
    if (error)
      throw assets::UserError(assets::ErrorKind::kOutput, file.string(), "the plot could not be put in place: " + error.message());
  }
  return true;
}

}  // namespace softreel::app
