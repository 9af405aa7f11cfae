#pragma once
// How the lighting program gets at the numbers of the pass.
#include <string>

#include "render/shader_sources.h"

namespace softreel::render {

/// The GLSL that hands the uniform block of a pass (shader_pass_block.cpp) on from the vertex to the fragment program
/// of the lighting. llvmpipe (Mesa 22.3) reads a uniform lane by lane, each lane checked against the buffer's size:
/// some 25 instructions a number, which made up more than half of the lighting program. An input that is flat over the
/// triangle is one broadcast.
struct PassInputs {
  std::string outputs;  ///< declarations in the vertex program
  std::string assign;   ///< statements of its main
  std::string inputs;   ///< in the fragment program: their declarations, the variable `pass`, and `void read_pass()`
};
PassInputs pass_inputs(const LightingFeatures& features);

}  // namespace softreel::render
