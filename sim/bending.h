#pragma once
// Bending of cloth over the inner edges of a triangle mesh.
#include <memory>

#include "sim/energy_term.h"
#include "sim/mesh.h"

namespace softreel::sim {

/// Quadratic bending of a sheet that is flat at rest (Bergou et al. 2006, "A quadratic bending model for inextensible
/// surfaces"): E = 1/2 sum_hinges k/(A_0 + A_1) |L x|^2, |L x| = |e| theta; constant Hessian.
/// `stiffness` k: flexural rigidity [N m] >= 0; curvature kappa stores k/2 kappa^2 per area. Rest vertex i is vertex
/// first_vertex + i of the state.
std::unique_ptr<EnergyTerm> make_quadratic_bending(const TriangleMesh& rest, double stiffness, int first_vertex);

/// Discrete shells (Grinspun et al. 2003): E = 1/2 sum_hinges k |e|^2/(A_0 + A_1) (theta - theta_0)^2, theta the angle
/// between the normals; for rest shapes that are not flat. Hessian after Tamstorf and Grinspun 2013, "Discrete
/// bending forces and their Jacobians". `stiffness` as above.
std::unique_ptr<EnergyTerm> make_discrete_shell_bending(const TriangleMesh& rest, double stiffness, int first_vertex);

/// True if every two triangles at an edge lie in one plane at rest (angle below 1e-6).
bool is_flat(const TriangleMesh& rest);

}  // namespace softreel::sim
