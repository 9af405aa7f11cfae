#pragma once
// Tetrahedral solid: linear tetrahedra, F = Ds Dm^-1, energy w psi(F) with w the rest volume.
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "sim/catalogue.h"
#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// Elastic energy of one solid. `rest`: rest shape; its vertex i is vertex first_vertex + i of the state.
/// young [Pa] > 0, poisson in (-1, 0.5). `material`: of `solid_materials()`. Throws std::invalid_argument for an
/// unknown one or a rest volume <= 0.
std::unique_ptr<EnergyTerm> make_solid(std::string_view material, double young, double poisson, const TetMesh& rest,
                                       int first_vertex);

/// Lumped mass of each vertex [kg]: a quarter of each adjacent tetrahedron's; density [kg/m^3].
std::vector<double> lumped_masses(const TetMesh& rest, double density);

}  // namespace softreel::sim
