#include "render/surface_pass.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace softreel::render {

GeometryFeatures geometry_features(const Look& look, const GpuMesh& mesh, bool emission) {
  GeometryFeatures f;
  f.field = look.color_map.has_value();
  f.emission = emission;
  if (f.field) return f;
  f.pattern = look.pattern != Pattern::kNone && mesh.has_rest();
  f.color_texture = look.texture && mesh.has_uv() && !f.pattern;
  f.normal_texture = look.normal_texture && mesh.has_uv();
  f.roughness_texture = look.roughness_texture && mesh.has_uv();
  f.emission_texture = emission && look.emission_texture && mesh.has_uv();
  return f;
}

void SurfacePass::bind_textures(const Look& look, const GeometryFeatures& features) {
  if (features.color_texture) textures_.bind(*look.texture, TextureKind::kColor, kColorTextureUnit);
  if (features.normal_texture) textures_.bind(*look.normal_texture, TextureKind::kNumbers, kNormalTextureUnit);
  if (features.roughness_texture) textures_.bind(*look.roughness_texture, TextureKind::kNumbers, kRoughnessTextureUnit);
  if (features.emission_texture) textures_.bind(*look.emission_texture, TextureKind::kColor, kEmissionTextureUnit);
}

void SurfacePass::draw_part(const GpuMesh& mesh, const MeshPart& part, const Look& look, float roughness, bool wire) {
  GeometryFeatures features = geometry_features(look, mesh, emission_);
  features.wire = wire;
  features.id = id_ != 0;
  const GLuint program = programs_.geometry(features);
  gl_.UseProgram(program);
  bind_textures(look, features);
  const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(mesh.world_from_mesh)));
  const glm::vec4 front(look.color, look.metallic);
  const glm::vec4 back(look.back_color.value_or(look.color), roughness);
  gl_.ProgramUniformMatrix4fv(program, kWorldFromMeshUniform, 1, GL_FALSE, glm::value_ptr(mesh.world_from_mesh));
  gl_.ProgramUniformMatrix3fv(program, kNormalMatrixUniform, 1, GL_FALSE, glm::value_ptr(normal_matrix));
  if (features.field) {
    const glm::vec4 map(static_cast<float>(*look.color_map), look.shading, 0, 0);
    gl_.ProgramUniform4fv(program, kColorMapUniform, 1, glm::value_ptr(map));
  } else {
    gl_.ProgramUniform4fv(program, kFrontColorUniform, 1, glm::value_ptr(front));
    gl_.ProgramUniform4fv(program, kBackColorUniform, 1, glm::value_ptr(back));
    gl_.ProgramUniform1f(program, kSheenUniform, look.sheen);
  }
  if (features.id) gl_.ProgramUniform1f(program, kIdUniform, static_cast<float>(id_));
  if (features.normal_texture) gl_.ProgramUniform1f(program, kNormalScaleUniform, look.normal_scale);
  if (features.emission) gl_.ProgramUniform3fv(program, kEmissionUniform, 1, glm::value_ptr(look.emission));
  if (features.pattern) {
    const float size = look.pattern == Pattern::kStripes ? -look.pattern_size : look.pattern_size;
    const glm::vec4 pattern(look.pattern_color, size);
    gl_.ProgramUniform4fv(program, kPatternUniform, 1, glm::value_ptr(pattern));
  }
  if (look.two_sided)
    gl_.Disable(GL_CULL_FACE);
  else
    gl_.Enable(GL_CULL_FACE);
  // The picture is drawn upside down, which turns every triangle round; a mirroring transform does it once more.
  const bool mirrored = glm::determinant(glm::mat3(mesh.world_from_mesh)) < 0;
  gl_.FrontFace(mirrored ? GL_CCW : GL_CW);
  mesh.draw(part.first_triangle, part.triangle_count);
  ++counters_.draw_calls;
}

void SurfacePass::draw_body(const GpuMesh& mesh) {
  // The least roughness that is not taken for the ground's mark.
  constexpr float kSmoothest = 1.0f / 255;
  for (const MeshPart& part : mesh.parts()) {
    const Look& look = mesh.look(part.look);
    draw_part(mesh, part, look, std::clamp(look.roughness, kSmoothest, 1.0f), false);
    if (!look.wire || id_ != 0) continue;
    Look edges;
    edges.color = *look.wire;
    edges.roughness = 1;
    edges.two_sided = look.two_sided;
    gl_.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    // In front of the faces that they belong to.
    gl_.Enable(GL_POLYGON_OFFSET_LINE);
    gl_.PolygonOffset(-1, -2);
    draw_part(mesh, part, edges, 1, true);
    gl_.Disable(GL_POLYGON_OFFSET_LINE);
    gl_.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
}

void SurfacePass::draw_ground(const GpuMesh& mesh, const Look& look) {
  Look matte;
  matte.color = look.color;
  matte.pattern = look.pattern;
  matte.pattern_color = look.pattern_color;
  matte.pattern_size = look.pattern_size;
  draw_part(mesh, mesh.parts()[0], matte, 0, false);
}

}  // namespace softreel::render
