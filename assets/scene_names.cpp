#include "assets/scene_names.h"

#include <array>

namespace softreel::assets {

namespace {
template <size_t n>
using Array = std::array<std::string_view, n>;

constexpr Array<2> kMassModel = {"lumped", "consistent"};
constexpr Array<2> kClothModel = {"membrane", "mass-spring"};
constexpr Array<3> kBendingModel = {"auto", "quadratic", "discrete-shell"};
constexpr Array<1> kTetrahedralizeMode = {"conform"};
constexpr Array<3> kUpAxis = {"x", "y", "z"};
constexpr Array<5> kColliderShape = {"plane", "sphere", "box", "capsule", "mesh"};
constexpr Array<3> kLightKind = {"area", "sun", "rectangle"};
constexpr Array<7> kView = {"free", "front", "back", "left", "right", "top", "bottom"};
constexpr Array<4> kQuantity = {"speed", "strain", "stress", "pressure"};
constexpr Array<3> kPattern = {"none", "checker", "stripes"};
constexpr Array<2> kProjection = {"perspective", "orthographic"};
constexpr Array<3> kQuality = {"draft", "default", "final"};
constexpr Array<4> kGroundMode = {"auto", "on", "off", "shadow"};
constexpr Array<5> kColorMap = {"viridis", "inferno", "magma", "cividis", "coolwarm"};
}  // namespace

Names names_of(MassModel) { return kMassModel; }
Names names_of(ClothModel) { return kClothModel; }
Names names_of(BendingModel) { return kBendingModel; }
Names names_of(TetrahedralizeMode) { return kTetrahedralizeMode; }
Names names_of(UpAxis) { return kUpAxis; }
Names names_of(ColliderShape) { return kColliderShape; }
Names names_of(LightKind) { return kLightKind; }
Names names_of(View) { return kView; }
Names names_of(Quantity) { return kQuantity; }
Names names_of(Pattern) { return kPattern; }
Names names_of(Projection) { return kProjection; }
Names names_of(Quality) { return kQuality; }
Names names_of(GroundMode) { return kGroundMode; }
Names names_of(ColorMap) { return kColorMap; }

}  // namespace softreel::assets
