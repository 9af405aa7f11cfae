#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "app/stability_plot.h"
#include "sim/catalogue.h"
#include "sim/stability.h"

namespace softreel::app {
namespace {

// The part of the plane that shows every region's bounds: forward Euler's ends at -2, rk4's at +-2.83 i, and bdf2
// leaves out a part of the right half that reaches to 4.
constexpr double kLeft = -3.5, kRight = 4.5, kTop = 3.5;
constexpr int kAcross = 121, kUp = 55;

double radius(std::string_view integrator, const std::complex<double>& z) {
  const double size = std::abs(z);
  if (size < 1e-12) return 1;
  return sim::spectral_radius(integrator, size, -z.real() / size);
}

std::string matrix_of(std::string_view integrator) {
  std::string rows;
  for (int r = -kUp; r <= kUp; ++r) {
    for (int c = 0; c < kAcross; ++c) {
      const std::complex<double> z(kLeft + (kRight - kLeft) * c / (kAcross - 1), kTop * std::abs(r) / kUp);
      // The inside is below 0; far away what counts is the sign alone.
      rows += fmt::format("{:.5g} ", std::clamp(std::log(radius(integrator, z)), -1.0, 1.0));
    }
    rows += '\n';
  }
  return rows;
}

}  // namespace

StudyPlot regions_plot() {
  std::vector<sim::MethodInfo> methods;
  for (const sim::MethodInfo& m : sim::integrators())
    if (m.order > 0) methods.push_back(m);
  constexpr int kColumns = 4;
  const int rows = (static_cast<int>(methods.size()) + kColumns - 1) / kColumns;
  std::string script = fmt::format(
      "set encoding utf8\nset multiplot layout {},{} margins 0.04,0.99,0.06,0.94 spacing 0.035,0.15\n"
      "set border lc rgb \"#999999\"\nset tics nomirror out scale 0.4 font \",9\" textcolor rgb \"#333333\"\n"
      "set palette defined (-1 \"#56b4e9\", 0 \"#56b4e9\", 0 \"#ffffff\", 1 \"#ffffff\")\nset cbrange [-1:1]\n"
      "unset colorbox\nunset key\nset size ratio -1\nset xrange [{}:{}]\nset yrange [{}:{}]\n"
      "set arrow 1 from {},0 to {},0 nohead lc rgb \"#777777\" lw 0.7 front\n"
      "set arrow 2 from 0,{} to 0,{} nohead lc rgb \"#777777\" lw 0.7 front\n",
      rows, kColumns, kLeft, kRight, -kTop, kTop, kLeft, kRight, -kTop, kTop);
  for (size_t k = 0; k < methods.size(); ++k) {
    script += fmt::format("set title \"{}\" noenhanced offset 0,-0.5 font \",11\"\n$m{} << EOD\n{}EOD\n",
                          methods[k].name, k, matrix_of(methods[k].name));
    // On the bound of a region that is the whole left half rounding decides: what is not above 1e-6 counts as inside.
    script += fmt::format("plot $m{} matrix using ({} + {}*$1):({} + {}*$2):($3 > 1e-6 ? 1 : -1) with image\n", k,
                          kLeft, (kRight - kLeft) / (kAcross - 1), -kTop, kTop / kUp);
  }
  return {"regions", script + "unset multiplot\n"};
}

}  // namespace softreel::app
