#pragma once
// Scalar fields u(x, t) on triangle meshes, one equation of each class of second-order partial differential equations:
//   poisson  (elliptic)    -Laplace u = f
//   heat     (parabolic)   u_t  = k   Laplace u + f
//   wave     (hyperbolic)  u_tt = c^2 Laplace u + f
// by linear finite elements, in the six steps of the method:
//   1. domain                the mesh, FieldProblem::mesh
//   2. elements              hat functions, hat_triangle (field_assembly.h)
//   3. assembly              K, M and the load, field_assembly.h
//   4. boundary conditions   FixedValues; where nothing is fixed nothing flows through the boundary (du/dn = 0)
//   5. solve                 field_solver.h: poisson once per load, the others step by step
//   6. post-processing       Field::value, range and energies here; colours and heights are the picture's
// In space the last two become M u' + k K u = F and M u'' + c^2 K u = F: what the integrators of bodies step, too.
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/catalogue.h"
#include "sim/field_assembly.h"
#include "sim/state.h"
#include "sim/step_report.h"

namespace softreel::sim {

/// Dirichlet condition u = value(x, t) at these vertices.
struct FixedValues {
  std::vector<int> vertices;
  FieldFunction value;
};

struct FieldProblem {
  std::string equation = "poisson";  ///< of field_equations()
  TriangleMesh mesh;                 ///< [m]
  double diffusivity = 1;            ///< k of heat [m^2/s], > 0
  double speed = 1;                  ///< c of wave [m/s], > 0
  FieldMass mass = FieldMass::kLumped;
  FieldFunction source;            ///< f
  FieldFunction initial;           ///< u at t = 0, where nothing is fixed
  FieldFunction initial_rate;      ///< u_t at t = 0, of a wave
  std::vector<FixedValues> fixed;  ///< of a vertex that is named twice the later one holds
};

/// What the wave keeps when nothing is fed in: 1/2 u_t^T M u_t and c^2/2 u^T K u.
struct FieldEnergies {
  double kinetic = 0, potential = 0;
};

class Field {
 public:
  /// `integrator`: of field_integrators(equation); poisson has none and ignores it. Throws std::invalid_argument for
  /// unknown names, for a mesh with flat triangles or unused vertices, and for a poisson problem without a fixed value
  /// on some piece of the mesh (its solution is free up to a constant there).
  Field(FieldProblem problem, std::string_view integrator);
  ~Field();
  Field(Field&&) noexcept;

  const FieldProblem& problem() const;
  double time() const;                   ///< [s]
  const Eigen::VectorXd& value() const;  ///< u, one per vertex
  const Eigen::VectorXd& rate() const;   ///< u_t of a wave, one per vertex; empty for the others
  FieldEnergies energies() const;        ///< of a wave; zero for the others
  const ScalarMatrix& stiffness() const;
  const ScalarMatrix& mass() const;

  /// Goes on by h [s] > 0. If the report says that it did not hold, the state is what it was before.
  StepReport step(double h);

  /// Everything beside u, u_t and t that later steps depend on; `restore` goes on from it with the same bits. Throws
  /// std::invalid_argument for sizes that do not belong to this field.
  std::vector<double> memory() const;
  void restore(double t, const Eigen::VectorXd& value, const Eigen::VectorXd& rate, std::span<const double> memory);

  /// Bound from above on the largest eigenvalue of the system that is stepped: of k M^-1 K (heat [1/s]) or c^2 M^-1 K
  /// (wave [1/s^2]), at the vertices that are free. By power iteration, with a margin of 5 % (it comes from below).
  double largest_eigenvalue() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softreel::sim
