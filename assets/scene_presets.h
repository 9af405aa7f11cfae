#pragma once
// Materials by name.
#include <string>
#include <string_view>
#include <vector>

#include "assets/scene.h"

namespace softreel::assets {

struct SolidPreset {
  const char* name;
  double young;    ///< [Pa]
  double poisson;  ///< [-]
  double density;  ///< [kg/m^3]
};

struct ClothPreset {
  const char* name;
  double young;      ///< [Pa]
  double poisson;    ///< [-]
  double thickness;  ///< [m]
  double bending;    ///< [N m]
  double density;    ///< [kg/m^3]
};

/// Null for an empty or unknown name.
const SolidPreset* find_solid_preset(std::string_view name);
const ClothPreset* find_cloth_preset(std::string_view name);
std::vector<std::string> solid_preset_names();
std::vector<std::string> cloth_preset_names();

/// Fills in the figures of `material.preset`; without a preset nothing changes.
void apply_preset(SolidMaterial& material);
void apply_preset(ClothMaterial& material);

}  // namespace softreel::assets
