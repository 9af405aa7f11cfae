#pragma once
// The GLSL pieces of a surface program, each in a file named after it.

namespace softreel::render {

extern const char* const kPassBlock;     ///< shader_pass_block.cpp: the uniform block
extern const char* const kReflectance;   ///< shader_reflectance.cpp: microfacet model, sky
extern const char* const kShadowLookup;  ///< shader_shadow.cpp: soft shadow of one part of a light
extern const char* const kSurfaceMain;   ///< shader_surface.cpp: puts them together

}  // namespace softreel::render
