#pragma once
// Integrators by their names.
#include <memory>
#include <string_view>

#include "sim/catalogue.h"
#include "sim/explicit_method.h"
#include "sim/implicit_method.h"

namespace softreel::sim {

/// Exactly one of the two is there.
struct Integrator {
  std::unique_ptr<ImplicitMethod> implicit_method;
  std::unique_ptr<ExplicitMethod> explicit_method;
};

/// `name`: of `integrators()`. Throws std::invalid_argument for an unknown one.
Integrator make_integrator(std::string_view name);

}  // namespace softreel::sim
