#include "sim/term_list.h"

#include <algorithm>

namespace softreel::sim {

TermList terms_of(const Model& model, std::span<const std::uint8_t> asleep) {
  const bool any = std::find(asleep.begin(), asleep.end(), 1) != asleep.end();
  std::vector<std::uint8_t> vertex_asleep;
  if (any)
    for (size_t b = 0; b < model.bodies.size(); ++b)
      vertex_asleep.insert(vertex_asleep.end(), static_cast<size_t>(model.bodies[b].count), asleep[b]);
  const auto takes_part = [&](const EnergyTerm& term) {
    if (!any || term.changing_stencils() || term.stencils().empty()) return true;
    return std::any_of(term.stencils().begin(), term.stencils().end(),
                       [&](int v) { return !vertex_asleep[static_cast<size_t>(v)]; });
  };
  TermList list;
  const auto add = [&](const auto& from, std::vector<EnergyTerm*>& to) {
    for (const auto& term : from)
      if (takes_part(*term)) to.push_back(term.get());
  };
  add(model.potentials, list.potentials);
  add(model.dissipations, list.dissipations);
  add(model.mass_corrections, list.mass_corrections);
  return list;
}

}  // namespace softreel::sim
