#include "app/method_list.h"

#include <fmt/format.h>

#include <array>

namespace softreel::app {

std::span<const MethodGroup> method_groups() {
  static const std::array groups = {
      MethodGroup{"time.integrator", "integrators", sim::integrators()},
      MethodGroup{"solver.method", "minimizers of an implicit step", sim::minimizers()},
      MethodGroup{"solver.hessian", "matrices of Newton's method", sim::hessian_modifications()},
      MethodGroup{"solver.line_search", "line searches", sim::line_searches()},
      MethodGroup{"solver.stop", "stopping tests", sim::stopping_tests()},
      MethodGroup{"solver.linear", "linear solvers", sim::linear_solvers()},
      MethodGroup{"solver.preconditioner", "preconditioners", sim::preconditioners()},
      MethodGroup{"soft.material.model", "materials of solids", sim::solid_materials()},
      MethodGroup{"cloth.material.model", "materials of membranes", sim::membrane_materials()},
      MethodGroup{"field.equation", "equations of fields", sim::field_equations()},
  };
  return groups;
}

std::string method_list_text() {
  std::string text;
  for (const MethodGroup& group : method_groups()) {
    text += fmt::format("{} ({})\n", group.title, group.key);
    for (const sim::MethodInfo& m : group.methods) {
      text += fmt::format("  {:<26} {}{}\n", m.name, m.order > 0 ? fmt::format("order {}; ", m.order) : "", m.help);
      text += fmt::format("  {:<26} cost: {}{}\n", "", m.cost,
                          m.source.empty() ? "" : fmt::format("; source: {}", m.source));
    }
    text += "\n";
  }
  return text;
}

}  // namespace softreel::app
