#pragma once
// Cloth as a finite-element membrane: linear triangles, F = Ds Dm^-1 (3x2), energy A t psi(F).
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "sim/catalogue.h"
#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// Stretching energy of a sheet. `rest`: rest shape (flat or not); its vertex i is vertex first_vertex + i of the
/// state. young [Pa] > 0, poisson in (-1, 1), thickness [m] > 0. Throws std::invalid_argument for an unknown
/// material or a triangle without area.
std::unique_ptr<EnergyTerm> make_membrane(std::string_view material, double young, double poisson, double thickness,
                                          const TriangleMesh& rest, int first_vertex);

/// Lumped mass of each vertex [kg]: a third of each adjacent triangle's; areal density [kg/m^2].
std::vector<double> lumped_masses(const TriangleMesh& rest, double areal_density);

}  // namespace softreel::sim
