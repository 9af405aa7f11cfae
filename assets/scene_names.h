#pragma once
// The names under which a scene file chooses between methods, in the order of their enumerators.
#include <span>
#include <string_view>

#include "assets/scene.h"

namespace softreel::assets {

using Names = std::span<const std::string_view>;

Names names_of(MassModel);
Names names_of(ClothModel);
Names names_of(BendingModel);
Names names_of(TetrahedralizeMode);
Names names_of(UpAxis);
Names names_of(ColliderShape);
Names names_of(LightKind);
Names names_of(Pattern);
Names names_of(View);
Names names_of(Quantity);
Names names_of(Projection);
Names names_of(Quality);
Names names_of(GroundMode);
Names names_of(ColorMap);

/// "implicit-euler"
template <class Enum>
std::string_view name_of(Enum value) {
  return names_of(value)[static_cast<size_t>(value)];
}

}  // namespace softreel::assets
