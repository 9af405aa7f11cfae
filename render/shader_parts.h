#pragma once
// The GLSL pieces of the programs, each in a file named after it.

namespace softreel::render {

extern const char* const kPassBlock;     ///< shader_pass_block.cpp: the uniform block `block`
extern const char* const kSky;           ///< shader_sky.cpp: light from everywhere
extern const char* const kReflectance;   ///< shader_reflectance.cpp: microfacet model
extern const char* const kShadowLookup;  ///< shader_shadow.cpp: soft shadow of one part of a light
extern const char* const kGeometryMain;  ///< shader_geometry.cpp: notes down the nearest surface
extern const char* const kLightingMain;  ///< shader_lighting.cpp: puts the pieces together

}  // namespace softreel::render
