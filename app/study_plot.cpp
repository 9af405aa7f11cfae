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
set border 11 lc rgb "#555555" lw 1
set tics nomirror out scale 0.6 textcolor rgb "#333333"
set grid xtics ytics lc rgb "#dddddd" lw 0.6 dt 1
set key below center maxcols 3 Left reverse spacing 1.3 samplen 2.4 width 1 height 0.5 textcolor rgb "#222222"
set xlabel textcolor rgb "#222222"
set ylabel textcolor rgb "#222222"
set y2label textcolor rgb "#222222"
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

std::string color_of(const std::vector<StudyRow>& rows, const std::string& method) {
  const std::string style = style_of(rows, method);
  return style.substr(0, style.find(" dt"));
}

bool failed(const StudyRow& r) { return r.run && r.failure && r.failure->step > 0; }

/// What a run that failed would have taken to the end, for its place in a plot [s].
double whole_seconds(const StudyRow& r, const StudyReference& reference) {
  const double steps = static_cast<double>(reference.points.size() - 1) / (reference.scene.time.fps * r.step);
  return r.wall / static_cast<double>(r.failure->step) * steps;
}

struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = 0;
  void add(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

/// Data blocks and the plot command over them.
struct Curves {
  std::string data, plots;
  void add(const std::string& points, const std::string& how) {
    data += fmt::format("$d{} << END\n{}END\n", count_, points);
    plots += fmt::format("{}$d{} {}", plots.empty() ? "plot " : ", \\\n  ", count_, how);
    ++count_;
  }

 private:
  int count_ = 0;
};

std::string tics(const char* axis, const std::vector<std::string>& list) {
  return fmt::format("set {}tics ({})\n", axis, fmt::join(list, ", "));
}

/// Each decade in percent of the size, in words that are read at a glance.
std::string percent_tics(double bottom, double top, double size) {
  std::vector<std::string> list;
  const int last = static_cast<int>(std::floor(std::log10(100 * top / size)));
  for (int e = static_cast<int>(std::ceil(std::log10(100 * bottom / size))); e <= last; ++e)
    list.push_back(e >= -3 && e <= 3 ? fmt::format("\"{0:.10g} %%\" {0:.10g}", std::pow(10, e))
                                     : fmt::format("\"10^{{{}}} %%\" {:.10g}", e, std::pow(10, e)));
  return tics("y2", list);
}

/// Decades of seconds, and with few of them 2 and 5 in between.
std::string second_tics(double left, double right) {
  std::vector<std::string> list;
  const bool few = right < 200 * left;
  for (int e = static_cast<int>(std::floor(std::log10(left))); e <= std::log10(right); ++e)
    for (const double m : {1.0, 2.0, 5.0}) {
      const double s = m * std::pow(10, e);
      if ((m != 1 && !few) || s < left || s > right) continue;
      list.push_back(s < 0.9e-3 ? fmt::format("\"{:.4g} µs\" {:.10g}", 1e6 * s, s)
                     : s < 0.9  ? fmt::format("\"{:.4g} ms\" {:.10g}", 1e3 * s, s)
                                : fmt::format("\"{:.4g} s\" {:.10g}", s, s));
    }
  return tics("x", list);
}

/// What all plots begin with.
std::string frame(const std::string& title, const std::string& below) {
  return kStyle +
         fmt::format(
             "set title {} noenhanced offset 0, 0.7 textcolor rgb \"#111111\"\nset label {} noenhanced at graph "
             "0.5, graph 1.035 center font \",9\" textcolor rgb \"#777777\"\n",
             text(title), text(below));
}

std::string range(const char* axis, double lo, double hi) {
  return fmt::format("set {}range [{:.6g}:{:.6g}]\n", axis, lo, hi);
}

}  // namespace

StudyPlot error_plot(const std::string& title, const std::vector<StudyRow>& rows, const StudyReference& reference) {
  Bounds x, y;
  for (const StudyRow& r : rows)
    if (r.done()) {
      x.add(r.wall);
      y.add(r.errors->worst);
    }
  if (!(x.hi > 0)) x.lo = x.hi = 1;
  if (!(y.hi > 0)) y.lo = y.hi = reference.size;
  const double floor = reference.floor;
  // One far below everything would squeeze the rest: it is told in words then.
  const double lowest = floor > 1e-3 * y.lo && floor < y.lo ? floor : y.lo;
  const double bottom = std::pow(10, std::floor(std::log10(lowest / (lowest == floor ? 8 : 1.5))));
  const double top = std::pow(10, std::ceil(std::log10(y.hi * 1.5)));
  const double left = x.lo / 1.6, right = x.hi * 1.6;
  std::string script = frame(title, fmt::format("measured against {}{}", reference.what,
                                                floor > 0 ? fmt::format(", whose own error is {:.1g} m", floor) : ""));
  script += "set logscale xyy2\nset format y \"10^{%L}\"\n";
  script += "set xlabel \"time of the simulation (wall, median)\"\n";
  script += "set ylabel \"position error: largest RMS of a frame [m]\"\n";
  script += "set ytics nomirror\nset y2label \"of the scene's size\"\n" + percent_tics(bottom, top, reference.size);
  script += second_tics(left, right);
  script += range("x", left, right) + range("y", bottom, top) +
            range("y2", 100 * bottom / reference.size, 100 * top / reference.size);
  if (const double percent = reference.size / 100; percent > bottom && percent < top)
    script += fmt::format(
        "set arrow from graph 0, first {0:.6g} to graph 1, first {0:.6g} nohead lc rgb \"#999999\" lw "
        "1 dt 3 back\n",
        percent);
  if (floor > bottom && floor < top)
    script += fmt::format(
        "set object rectangle from graph 0, graph 0 to graph 1, first {0:.6g} fc rgb \"#e6e6e6\" fs "
        "solid noborder behind\nset label \"below the reference's own error\" at graph 0.01, first "
        "{0:.6g} left offset 0, -0.6 font \",9\" textcolor rgb \"#777777\"\n",
        floor);
  Curves curves;
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
    curves.add(points, fmt::format("with linespoints {} title {} noenhanced", style_of(rows, method), text(name)));
  }
  bool failures = false;
  for (const std::string& method : methods_of(rows)) {
    std::string points;
    for (const StudyRow& r : rows)
      if (r.method == method && failed(r))
        points += fmt::format("{:.6g} {:.6g}\n", std::clamp(whole_seconds(r, reference), left * 1.05, right / 1.05),
                              top * 0.75);
    if (points.empty()) continue;
    curves.add(points, fmt::format("with points {} pt 2 ps 1.0 notitle", color_of(rows, method)));
    failures = true;
  }
  for (const StudyRow& r : rows)
    if (r.present && r.done() && r.errors->worst > 0)
      curves.add(fmt::format("{:.6g} {:.6g}\n", r.wall, r.errors->worst),
                 "with points pt 6 ps 2.2 lw 1.6 lc rgb \"#111111\" title \"the scene now\"");
  if (failures) curves.plots += ", \\\n  NaN with points pt 2 ps 1.0 lc rgb \"#555555\" title \"failed (at the top)\"";
  if (curves.plots.empty()) curves.plots = "plot NaN notitle";
  return {"error", script + curves.data + curves.plots + "\n"};
}

StudyPlot energy_plot(const std::string& title, const std::vector<StudyRow>& rows, const assets::Scene& scene) {
  Curves curves;
  std::vector<std::string> integrators;
  for (const StudyRow& r : rows)
    if (r.done() && r.drifts.energy &&
        std::find(integrators.begin(), integrators.end(), r.integrator) == integrators.end())
      integrators.push_back(r.integrator);
  for (const std::string& integrator : integrators) {
    const StudyRow* chosen = nullptr;
    const auto off = [&](const StudyRow& r) { return std::abs(std::log(r.step / scene.time.step())); };
    for (const StudyRow& r : rows)
      if (r.integrator == integrator && r.done() && (!chosen || off(r) < off(*chosen))) chosen = &r;
    std::string points;
    for (size_t f = 0; f < chosen->energy.size(); ++f)
      points += fmt::format("{:.6g} {:.6g}\n", static_cast<double>(f) / scene.time.fps, chosen->energy[f]);
    curves.add(points,
               fmt::format("with lines {} title {} noenhanced", style_of(rows, chosen->method), text(chosen->label)));
  }
  if (curves.plots.empty()) return {"energy", ""};
  std::string script = frame(title, "kinetic, elastic, of gravity and contact, and what damping took");
  script +=
      "set xlabel \"time in the clip [s]\"\nset ylabel \"change of the total energy [J]\"\nset format y \"%.3g\"\n";
  script += range("x", 0, (scene.time.frames() - 1) / scene.time.fps);
  return {"energy", script + curves.data + curves.plots + "\n"};
}

bool draw_plot(const StudyPlot& plot, const std::filesystem::path& folder) {
  if (find_program("gnuplot").empty()) return false;
  for (const auto& [ending, terminal] :
       {std::pair{".svg", "svg size 900,640 dynamic font \"DejaVu Sans,12\" background \"#ffffff\""},
        std::pair{".png",
                  "pngcairo size 1500,1060 font \"DejaVu Sans,12\" fontscale 1.4 linewidth 1.6 pointscale 1.5 "
                  "background \"#ffffff\""}}) {
    const std::filesystem::path file = folder / (plot.name + ending);
    const std::filesystem::path temporary = folder / fmt::format(".{}.{}{}", plot.name, getpid(), ending);
    const RemovedAtEnd removed{temporary};
    PipeTo gnuplot({"gnuplot"}, stop_if_interrupted);
    const std::string script =
        fmt::format("set terminal {}\nset output {}\n{}", terminal, text(temporary.string()), plot.script);
    const bool reading = gnuplot.write(script.data(), script.size());
    const int code = gnuplot.finish();
    std::error_code error;
    if (code != 0 || !reading || !std::filesystem::exists(temporary, error))
      throw assets::UserError(assets::ErrorKind::kOutput, file.string(),
                              fmt::format("gnuplot could not draw it (exit code {}): {}", code, gnuplot.complaint()));
    std::filesystem::rename(temporary, file, error);
    if (error)
      throw assets::UserError(assets::ErrorKind::kOutput, file.string(),
                              "the plot could not be put in place: " + error.message());
  }
  return true;
}

}  // namespace softreel::app
