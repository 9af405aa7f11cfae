#pragma once
// The energy densities of sim/NUMERICS' table written once more, in principal stretches and for any scalar: what the
// materials are measured against. A complex argument gives exact derivatives (complex step, Squire and Trapp 1998).
#include <complex>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "sim/materials/lame.h"

namespace softreel::tests {

using Complex = std::complex<double>;

/// psi of as many stretches as the body has dimensions; `lame`: of a solid or of a surface.
inline Complex stretch_energy(std::string_view material, const std::vector<Complex>& s, const sim::Lame& lame) {
  const double D = static_cast<double>(s.size()), mu = lame.mu, lambda = lame.lambda;
  Complex J = 1, trace = 0, norm = 0, squares = 0, green = 0, green2 = 0;
  for (const Complex& x : s) {
    const Complex e = (x * x - 1.0) / 2.0;
    J *= x, trace += x - 1.0, norm += x * x, squares += (x - 1.0) * (x - 1.0), green += e, green2 += e * e;
  }
  if (material == "stvk") return mu * green2 + lambda / 2 * green * green;
  if (material == "corotated") return mu * squares;
  if (material == "corotated-det") return mu * squares + lambda / 2 * (J - 1.0) * (J - 1.0);
  if (material == "linear" || material == "corotated-volume") return mu * squares + lambda / 2 * trace * trace;
  if (material == "stable-neo-hookean") {
    const double m = D == 3 ? 4 * mu / 3 : 3 * mu / 2, l = D == 3 ? lambda + 5 * mu / 6 : lambda + 2 * mu / 3;
    const double a = D == 3 ? 1 + 3 * m / (4 * l) : 1 + 2 * m / (3 * l);
    return m / 2 * (norm - D) + l / 2 * ((J - a) * (J - a)) - m / 2 * std::log(norm + 1.0);
  }
  throw std::invalid_argument("a material whose energy the tests do not know: write it here");
}

/// d psi / d s_i [Pa].
inline double stretch_stress(std::string_view material, const std::vector<double>& s, size_t i, const sim::Lame& lame) {
  std::vector<Complex> z(s.begin(), s.end());
  const double h = 1e-30;
  z[i] += Complex(0, h);
  return stretch_energy(material, z, lame).imag() / h;
}

/// The lateral stretch at which a body stretched by `s` along axis 0 has no lateral stress, by bisection (psi is
/// convex in it there).
inline double free_lateral_stretch(std::string_view material, double s, size_t dimensions, const sim::Lame& lame) {
  double lo = 0.6, hi = 1.4;
  for (int i = 0; i < 200; ++i) {
    const double mid = (lo + hi) / 2;
    std::vector<double> stretches(dimensions, mid);
    stretches[0] = s;
    (stretch_stress(material, stretches, 1, lame) > 0 ? hi : lo) = mid;
  }
  return (lo + hi) / 2;
}

}  // namespace softreel::tests
