#include "sim/integrators.h"

#include "sim/integrators/bdf2.h"
#include "sim/integrators/implicit_euler.h"
#include "sim/integrators/implicit_midpoint.h"
#include "sim/integrators/newmark.h"
#include "sim/integrators/runge_kutta.h"
#include "sim/integrators/static_equilibrium.h"
#include "sim/integrators/symplectic_euler.h"
#include "sim/integrators/verlet.h"
#include "sim/method_table.h"

namespace softreel::sim {
namespace {

struct Entry {
  MethodInfo info;
  Integrator (*make)();
  bool implicit;
};

template <class Method>
constexpr Entry implicit_entry() {
  return {Method::kInfo, [] { return Integrator{std::make_unique<Method>(), nullptr}; }, true};
}
template <class Method>
constexpr Entry explicit_entry() {
  return {Method::kInfo, [] { return Integrator{nullptr, std::make_unique<Method>()}; }, false};
}

// The one table of integrators: a new one is its header and a line here.
constexpr std::array kIntegrators = {
    implicit_entry<ImplicitEuler>(),
    implicit_entry<Newmark>(),
    implicit_entry<ImplicitMidpoint>(),
    implicit_entry<Bdf2>(),
    implicit_entry<StaticEquilibrium>(),
    explicit_entry<ForwardEuler>(),
    explicit_entry<SymplecticEuler>(),
    explicit_entry<SymplecticEulerPosition>(),
    explicit_entry<Heun>(),
    explicit_entry<Midpoint>(),
    explicit_entry<Rk4>(),
    explicit_entry<Verlet>(),
    explicit_entry<Leapfrog>(),
};

}  // namespace

Catalogue integrators() { return catalogue_of<kIntegrators>(); }

Integrator make_integrator(std::string_view name) { return find_method(kIntegrators, name, "integrator").make(); }

bool is_implicit(std::string_view name) { return find_method(kIntegrators, name, "integrator").implicit; }

}  // namespace softreel::sim
