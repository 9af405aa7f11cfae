#include "assets/scene_presets.h"

#include <algorithm>
#include <array>

namespace softreel::assets {

namespace {

// Typical figures of the field's handbooks (Ashby, Materials Selection in Mechanical Design, app. A, for rubber to
// steel). Rubber and jelly are closer to incompressible than given: linear tetrahedra lock from about 0.48 on.
constexpr std::array kSolid = {
    SolidPreset{"jelly", 1e4, 0.45, 1050},       // 10 % gelatine: 5 to 30 kPa
    SolidPreset{"flesh", 3e4, 0.45, 1060},       // muscle at rest
    SolidPreset{"foam", 1e5, 0.3, 50},           // upholstery, flexible polyurethane
    SolidPreset{"silicone", 5e5, 0.47, 1100},    // soft casting grade
    SolidPreset{"rubber", 2e6, 0.47, 930},       // natural, vulcanized
    SolidPreset{"cork", 3e7, 0.05, 180},         //
    SolidPreset{"plastic", 2.5e9, 0.38, 1050},   // polystyrene, ABS
    SolidPreset{"wood", 1e10, 0.35, 600},        // along the grain; taken as the same in every direction
    SolidPreset{"aluminium", 7e10, 0.33, 2700},  //
    SolidPreset{"steel", 2.1e11, 0.3, 7850},     //
};

// Bending after measurements with Kawabata's system (cotton shirting 0.05 to 0.1 gf cm^2/cm, 1 gf cm^2/cm = 9.8e-5 N m;
// silk 0.03, wool 0.12, denim 0.5), Young's modulus for small stretches, density from the usual weight per area.
// Leather, paper and rubber sheet bend like plates: E t^3 / (12 (1 - nu^2)).
constexpr std::array kCloth = {
    ClothPreset{"silk", 1e7, 0.3, 1.5e-4, 3e-6, 450},          // 70 g/m^2
    ClothPreset{"cotton", 1e7, 0.3, 4e-4, 8e-6, 375},          // 150 g/m^2
    ClothPreset{"wool", 3e6, 0.3, 7e-4, 1.2e-5, 330},          // 230 g/m^2
    ClothPreset{"denim", 3e7, 0.3, 8e-4, 5e-5, 500},           // 400 g/m^2
    ClothPreset{"leather", 5e7, 0.35, 1e-3, 4.7e-3, 860},      // garment leather
    ClothPreset{"paper", 3e9, 0.2, 1e-4, 2.6e-4, 800},         // 80 g/m^2
    ClothPreset{"rubber", 2e6, 0.47, 1e-3, 2.1e-4, 930},       // a sheet of 1 mm
    ClothPreset{"stretch-jersey", 1e5, 0.3, 6e-4, 2e-6, 350},  // knitted with elastane
};

template <class Presets>
auto find(const Presets& presets, std::string_view name) -> decltype(presets.data()) {
  const auto it = std::find_if(presets.begin(), presets.end(), [&](const auto& p) { return name == p.name; });
  return it == presets.end() ? nullptr : &*it;
}

template <class Presets>
std::vector<std::string> names(const Presets& presets) {
  std::vector<std::string> out;
  for (const auto& p : presets) out.emplace_back(p.name);
  return out;
}

}  // namespace

const SolidPreset* find_solid_preset(std::string_view name) { return find(kSolid, name); }
const ClothPreset* find_cloth_preset(std::string_view name) { return find(kCloth, name); }
std::vector<std::string> solid_preset_names() { return names(kSolid); }
std::vector<std::string> cloth_preset_names() { return names(kCloth); }

void apply_preset(SolidMaterial& material) {
  if (const SolidPreset* p = find_solid_preset(material.preset)) {
    material.young = p->young;
    material.poisson = p->poisson;
  }
}

void apply_preset(ClothMaterial& material) {
  if (const ClothPreset* p = find_cloth_preset(material.preset)) {
    material.young = p->young;
    material.poisson = p->poisson;
    material.thickness = p->thickness;
    material.bending = p->bending;
  }
}

}  // namespace softreel::assets
