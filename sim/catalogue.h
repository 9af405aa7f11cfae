#pragma once
// The methods that a scene can choose by name. Each table lives beside what it makes: solid.cpp, membrane.cpp,
// integrators.cpp, field.cpp, minimizer.cpp, newton.cpp, line_search.cpp, convergence_test.cpp, linear_solver.cpp,
// preconditioner.cpp.
#include <span>
#include <string_view>

#include "sim/materials/traits.h"

namespace softreel::sim {

struct MethodInfo {
  std::string_view name;    ///< as in the scene file
  std::string_view help;    ///< one line for the user
  std::string_view cost;    ///< cost class: what one evaluation, step or solve takes
  std::string_view source;  ///< author, year, section
  int order = 0;            ///< of accuracy in time; 0 for what is no integrator, or has none
};

using Catalogue = std::span<const MethodInfo>;

Catalogue solid_materials();
Catalogue membrane_materials();

/// What a material of these tables can and cannot. Throws std::invalid_argument for an unknown one.
const MaterialTraits& solid_traits(std::string_view material);
const MaterialTraits& membrane_traits(std::string_view material);

Catalogue integrators();
/// True if the integrator solves a system each step; `name` is one of `integrators()`.
bool is_implicit(std::string_view integrator);
Catalogue minimizers();
Catalogue hessian_modifications();
Catalogue line_searches();
Catalogue stopping_tests();
Catalogue linear_solvers();
Catalogue preconditioners();
Catalogue field_equations();
/// Those that an equation of a field can be stepped with; none for one that is only solved. Throws
/// std::invalid_argument for an unknown equation.
Catalogue field_integrators(std::string_view equation);

}  // namespace softreel::sim
