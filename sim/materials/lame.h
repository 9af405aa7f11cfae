#pragma once
// Elastic constants.

namespace softreel::sim {

struct Lame {
  double mu = 0;      ///< shear modulus [Pa]
  double lambda = 0;  ///< first Lame parameter [Pa]
};

/// Of a solid; young [Pa] > 0, poisson in (-1, 0.5).
constexpr Lame solid_lame(double young, double poisson) {
  return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

/// Of a thin sheet in plane stress; young [Pa] > 0, poisson in (-1, 1).
constexpr Lame surface_lame(double young, double poisson) {
  return {young / (2 * (1 + poisson)), young * poisson / (1 - poisson * poisson)};
}

}  // namespace softreel::sim
