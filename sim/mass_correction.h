#pragma once
// Consistent mass, as what it has over the lumped one.
#include <memory>

#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// What the consistent mass matrix of linear elements has over the lumped one, as the quadratic form
/// q^T (M_consistent - M_lumped) q / 2: m/(K (K + 1)) (1 + delta_ij) instead of m/K delta_ij for an element of K
/// corners and mass m (Hughes 2000, section 7.3.2). It is negative semi-definite; the sum is positive definite.
/// `density`: [kg/m^3] of a solid, [kg/m^2] of a sheet; vertex i of `rest` is vertex first_vertex + i of the state.
std::unique_ptr<EnergyTerm> make_mass_correction(const TetMesh& rest, double density, int first_vertex);
std::unique_ptr<EnergyTerm> make_mass_correction(const TriangleMesh& rest, double density, int first_vertex);

}  // namespace softreel::sim
