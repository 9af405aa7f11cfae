#pragma once
// The terms of a model that take part in steps: all, or those of bodies that are awake.
#include <cstdint>
#include <span>
#include <vector>

#include "sim/model.h"

namespace softreel::sim {

struct TermList {
  std::vector<EnergyTerm*> potentials, dissipations, mass_corrections;  ///< in the order of the model
};

/// Without the terms of which every vertex belongs to a body that is asleep (one flag per body of the model). Terms
/// without stencils, and those whose stencils change, stay.
TermList terms_of(const Model& model, std::span<const std::uint8_t> asleep);

}  // namespace softreel::sim
