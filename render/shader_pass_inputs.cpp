#include "render/shader_pass_inputs.h"

#include <fmt/format.h>

#include <bit>
#include <vector>

namespace softreel::render {

namespace {

constexpr int kMostInputs = 30;  // vec4s; llvmpipe takes 32. What does not fit is read from the block.

struct Field {
  std::string name;
  int columns;  // of four numbers each: 4 is a mat4
};

std::vector<Field> fields_used(const LightingFeatures& f) {
  std::vector<Field> fields = {{"world_from_clip", 4}, {"picture", 1}, {"camera", 1}};
  if (f.sky_shadow) fields.insert(fields.end(), {{"sky_direction", 1}, {"sky_part", 1}});
  if (!f.panorama) fields.insert(fields.end(), {{"sky", 1}, {"ground_light", 1}});
  if (f.ground) fields.push_back({"ground", 1});
  for (int i = 0; i < f.lights; ++i)
    for (const char* part : {"place", "color", "extra", "facing"})
      fields.push_back({fmt::format("lights[{}].{}", i, part), 1});
  const int maps = std::popcount(f.shadow_lights) + (f.sky_shadow ? 1 : 0);
  for (int i = 0; i < maps; ++i) {
    for (const char* part : {"filter_size", "depth"}) fields.push_back({fmt::format("shadows[{}].{}", i, part), 1});
    for (const char* part : {"map_from_world", "plane_from_world"})
      fields.push_back({fmt::format("shadows[{}].{}", i, part), 4});
  }
  if (f.panorama)
    for (int i = 0; i < 9; ++i) fields.push_back({fmt::format("harmonics[{}]", i), 1});
  return fields;
}

}  // namespace

PassInputs pass_inputs(const LightingFeatures& features) {
  PassInputs result;
  std::string read;
  int used = 0;
  for (const Field& field : fields_used(features)) {
    if (field.name.ends_with(".facing") && !features.rectangles) continue;
    if (used + field.columns > kMostInputs) {
      read += fmt::format("  pass.{0} = block.{0};\n", field.name);
      continue;
    }
    std::string columns;
    for (int column = 0; column < field.columns; ++column, ++used) {
      result.outputs += fmt::format("flat out vec4 pass_{};\n", used);
      result.inputs += fmt::format("flat in vec4 pass_{};\n", used);
      result.assign += field.columns == 1 ? fmt::format("  pass_{} = block.{};\n", used, field.name)
                                          : fmt::format("  pass_{} = block.{}[{}];\n", used, field.name, column);
      columns += fmt::format("{}pass_{}", column == 0 ? "" : ", ", used);
    }
    read += fmt::format("  pass.{} = {}({});\n", field.name, field.columns == 1 ? "vec4" : "mat4", columns);
  }
  result.inputs += fmt::format("PassData pass;\nvoid read_pass() {{\n{}}}\n", read);
  return result;
}

}  // namespace softreel::render
