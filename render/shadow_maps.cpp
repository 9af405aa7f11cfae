#include "render/shadow_maps.h"

#include <glm/gtc/type_ptr.hpp>

#include "render/shader_sources.h"

namespace softreel::render {

ShadowMaps::ShadowMaps(const GlFunctions& gl, int size, int layers)
    : gl_(gl), size_(size), program_(gl, shadow_vertex_source(), shadow_fragment_source()) {
  GLuint name = 0;
  gl.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  texture_ = GlTexture(gl, name);
  gl.TextureStorage3D(name, 1, GL_DEPTH_COMPONENT32F, size, size, layers);
  check_gl(gl, "make shadow maps");
  for (int layer = 0; layer < layers; ++layer) {
    GlFramebuffer framebuffer = make_framebuffer(gl);
    gl.NamedFramebufferTextureLayer(*framebuffer, GL_DEPTH_ATTACHMENT, name, 0, layer);
    gl.NamedFramebufferDrawBuffer(*framebuffer, GL_NONE);
    gl.NamedFramebufferReadBuffer(*framebuffer, GL_NONE);
    check_framebuffer(gl, framebuffer, "a shadow map");
    framebuffers_.push_back(std::move(framebuffer));
  }
  // Beside the map there is nothing in the way of the light.
  const glm::vec4 farthest(1);
  compare_ = make_sampler(gl, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_BORDER);
  gl.SamplerParameterfv(*compare_, GL_TEXTURE_BORDER_COLOR, glm::value_ptr(farthest));
  gl.SamplerParameteri(*compare_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.SamplerParameteri(*compare_, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  plain_ = make_sampler(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_BORDER);
  gl.SamplerParameterfv(*plain_, GL_TEXTURE_BORDER_COLOR, glm::value_ptr(farthest));
  check_gl(gl, "set up shadow maps");
}

void ShadowMaps::draw(int layer, const glm::mat4& clip_from_world, std::span<const GpuMesh* const> casters,
                      RenderCounters& counters) {
  const GLuint framebuffer = *framebuffers_[static_cast<std::size_t>(layer)];
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.Viewport(0, 0, size_, size_);
  constexpr float kFarthest = 1;
  gl_.DepthMask(GL_TRUE);
  gl_.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &kFarthest);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_BLEND);
  gl_.CullFace(GL_BACK);
  gl_.UseProgram(*program_);
  for (const GpuMesh* mesh : casters) {
    const glm::mat4 clip_from_mesh = clip_from_world * mesh->world_from_mesh;
    gl_.ProgramUniformMatrix4fv(*program_, kClipFromMeshUniform, 1, GL_FALSE, glm::value_ptr(clip_from_mesh));
    // Of what is seen from both sides, both cast; of a closed body the side towards the light hides the other.
    if (mesh->two_sided())
      gl_.Disable(GL_CULL_FACE);
    else
      gl_.Enable(GL_CULL_FACE);
    gl_.FrontFace(glm::determinant(glm::mat3(mesh->world_from_mesh)) < 0 ? GL_CW : GL_CCW);
    mesh->draw(0, mesh->triangle_count());
    ++counters.draw_calls;
  }
  ++counters.shadow_passes;
}

void ShadowMaps::bind() const {
  gl_.BindTextureUnit(kShadowCompareUnit, *texture_);
  gl_.BindSampler(kShadowCompareUnit, *compare_);
  gl_.BindTextureUnit(kShadowDepthUnit, *texture_);
  gl_.BindSampler(kShadowDepthUnit, *plain_);
}

}  // namespace softreel::render
