#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <stdexcept>

#include "render/color_map.h"
#include "render/error_estimate.h"
#include "render/gl_context.h"
#include "render/gpu_mesh.h"
#include "render/pass_setup.h"
#include "render/picture_inputs.h"
#include "render/picture_targets.h"
#include "render/programs.h"
#include "render/sampling.h"
#include "render/shadow_maps.h"
#include "render/surface_pass.h"

namespace softreel::render {

namespace {

void check_options(const RenderOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kMaxImageSide || options.height > kMaxImageSide)
    throw std::invalid_argument(fmt::format("a picture of {} x {} pixels: each side must be 1 to {}", options.width,
                                            options.height, kMaxImageSide));
  if (options.samples < 1 || options.samples > 65536)
    throw std::invalid_argument(fmt::format("{} samples: must be 1 to 65536", options.samples));
  if (options.shadow_map_size != 0 && (options.shadow_map_size < 16 || options.shadow_map_size > 8192))
    throw std::invalid_argument(
        fmt::format("shadow maps of {} texels: must be 16 to 8192, or 0", options.shadow_map_size));
}

constexpr int kFirstPasses = 8;  // before the error of a picture is estimated

int shadow_map_size(const RenderOptions& options) {
  if (options.shadow_map_size != 0) return options.shadow_map_size;
  // Each of few passes blurs its shadow so far that finer maps only add grain (and cost: they do not fit the cache).
  // At 1280 x 720 the error of 4 to 16 passes is least near 512 texels, of 64 near 1024.
  constexpr int kManyPasses = 32;
  const int size = options.samples < kManyPasses ? 512 : 1024;
  return std::max(options.width, options.height) <= 1280 ? size : 2 * size;
}

}  // namespace

struct Renderer::State {
  explicit State(const RenderOptions& asked)
      : options(asked),
        gl(load_gl_functions()),
        targets(gl, asked.width, asked.height),
        programs(gl),
        textures(gl),
        color_maps(gl),
        panorama(gl) {
    no_vertices = make_vertex_array(gl);
    pass_buffer = make_buffer(gl, sizeof(PassUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  }

  RenderOptions options;
  GlContext context;
  GlFunctions gl;
  RenderCounters counters;
  PictureReport report;
  PictureTargets targets;
  Programs programs;
  Textures textures;
  ColorMapTexture color_maps;
  PanoramaTexture panorama;
  GlBuffer pass_buffer;
  GlVertexArray no_vertices;
  std::optional<ShadowMaps> shadow_maps;
  std::vector<std::unique_ptr<GpuMesh>> meshes;
  std::unique_ptr<GpuMesh> ground;
  struct LastPicture {
    PictureInputs inputs;
    Image picture;
    PictureReport report;
  };
  std::optional<LastPicture> last_picture;  // one drawn with the shutter closed

  PictureInputs inputs(const Camera& camera, std::span<const Light> lights, const Environment& environment) const {
    PictureInputs result{camera, {lights.begin(), lights.end()}, environment, options.seed, {}};
    for (const auto& mesh : meshes)
      result.meshes.push_back({mesh->revision(), mesh->world_from_mesh, mesh->visible, mesh->casts_shadow});
    return result;
  }

  GpuMesh& mesh(MeshId id) {
    if (id >= meshes.size()) throw std::invalid_argument(fmt::format("mesh {} of {}", id, meshes.size()));
    return *meshes[id];
  }

  std::vector<const GpuMesh*> drawn() const {
    std::vector<const GpuMesh*> result;
    for (const auto& mesh : meshes)
      if (mesh->visible && mesh->has_positions()) result.push_back(mesh.get());
    return result;
  }

  bool has_fields() const {
    return std::any_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return mesh->is_field(); });
  }

  bool has_emission() const {
    return std::any_of(meshes.begin(), meshes.end(), [](const auto& mesh) {
      return std::any_of(mesh->looks().begin(), mesh->looks().end(), [](const Look& look) { return look.emits(); });
    });
  }

  void upload_changes() {
    for (const auto& mesh : meshes) {
      if (!mesh->visible) continue;
      mesh->upload(counters);
      for (const Look& look : mesh->looks())
        if (mesh->has_uv()) add_textures(look);
    }
  }

  void add_textures(const Look& look) {
    const auto add = [&](const std::shared_ptr<const Image>& image, TextureKind kind) {
      if (image) textures.add(*image, kind, counters);
    };
    add(look.texture, TextureKind::kColor);
    add(look.normal_texture, TextureKind::kNumbers);
    add(look.roughness_texture, TextureKind::kNumbers);
    add(look.emission_texture, TextureKind::kColor);
  }

  void prepare_ground(const Ground& plan) {
    if (!ground) {
      Shape shape = make_plane(2, 2);
      ground = std::make_unique<GpuMesh>(gl, std::move(shape.mesh), std::vector<Look>{Look{}});
      ground->set_positions(shape.positions);
      ground->upload(counters);
    }
    const float reach = std::max(plan.fade_end, plan.fade_begin);
    if (plan.look.pattern != Pattern::kNone) ground->set_rest_of_square(reach);
    ground->world_from_mesh = glm::translate(glm::mat4(1), glm::vec3(plan.centre.x, plan.height, plan.centre.z)) *
                              glm::scale(glm::mat4(1), glm::vec3(reach, 1, reach));
  }

  void prepare_shadow_maps(int layers) {
    if (layers == 0 || (shadow_maps && shadow_maps->layers() >= layers)) return;
    shadow_maps.emplace(gl, shadow_map_size(options), layers);
    ++counters.shadow_maps;
  }

  LightingFeatures features_of(const PictureSetup& picture, const std::vector<const GpuMesh*>& meshes_drawn,
                               const Environment& environment) const {
    LightingFeatures features;
    features.lights = static_cast<int>(picture.lights.size());
    for (std::size_t light = 0; light < picture.lights.size(); ++light)
      if (picture.shadow_map[light] >= 0) features.shadow_lights |= 1u << light;
    features.rectangles = std::any_of(picture.lights.begin(), picture.lights.end(),
                                      [](const Light& light) { return light.kind == LightKind::kRectangle; });
    features.sky_shadow = picture.sky_map >= 0;
    features.ground = environment.ground.visible;
    features.field = has_fields();
    features.emission = has_emission();
    features.panorama = environment.panorama != nullptr;
    features.panorama_behind = features.panorama && environment.panorama_behind && !environment.transparent;
    features.shadow_catcher = environment.ground.visible && environment.ground.catches_shadow;
    for (const GpuMesh* mesh : meshes_drawn)
      for (const Look& look : mesh->looks()) features.sheen = features.sheen || look.sheen > 0;
    // What few passes cannot average they must filter.
    const int passes = options.samples;
    features.shadow_taps = passes == 1 ? 8 : passes < 8 ? 6 : 3;
    return features;
  }

  void draw_surfaces(const std::vector<const GpuMesh*>& meshes_drawn, const Environment& environment) {
    SurfacePass pass(gl, programs, textures, counters, has_emission());
    for (const GpuMesh* mesh : meshes_drawn) pass.draw_body(*mesh);
    if (environment.ground.visible) pass.draw_ground(*ground, environment.ground.look);
  }

  void draw_shadow_maps(const PassSetup& setup, const std::vector<const GpuMesh*>& meshes_drawn) {
    std::vector<const GpuMesh*> casters;
    std::copy_if(meshes_drawn.begin(), meshes_drawn.end(), std::back_inserter(casters),
                 [](const GpuMesh* mesh) { return mesh->casts_shadow; });
    for (std::size_t map = 0; map < setup.shadow_clip_from_world.size(); ++map)
      shadow_maps->draw(static_cast<int>(map), setup.shadow_clip_from_world[map], casters, counters);
    if (!setup.shadow_clip_from_world.empty()) shadow_maps->bind();
  }

  void draw_pass(const PictureSetup& picture, const Environment& environment, const PassSample& sample, int pass) {
    const PassSetup setup = set_up_pass(picture, environment, sample, pass);
    const std::vector<const GpuMesh*> meshes_drawn = drawn();
    draw_shadow_maps(setup, meshes_drawn);

    gl.NamedBufferSubData(*pass_buffer, 0, sizeof(PassUniforms), &setup.uniforms);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, kPassBinding, *pass_buffer);
    if (has_emission()) targets.add_emission();
    targets.begin_geometry();
    draw_surfaces(meshes_drawn, environment);

    if (has_fields()) {
      targets.add_display();
      color_maps.bind();
    }
    if (environment.panorama) panorama.bind(*environment.panorama, counters);
    targets.begin_lighting(pass, picture.passes, counters);
    gl.UseProgram(programs.lighting(features_of(picture, meshes_drawn, environment)));
    gl.BindVertexArray(*no_vertices);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    ++counters.draw_calls;
    ++counters.passes;
  }

  Bounds world_bounds() const {
    Bounds bounds;
    for (const GpuMesh* mesh : drawn()) bounds.add(mesh->world_bounds());
    return bounds;
  }

  Channels channels(const PictureSetup& picture, const Environment& environment) {
    const PassSetup setup = set_up_pass(picture, environment, pass_samples(1, 0, 0).front(), 0);
    gl.NamedBufferSubData(*pass_buffer, 0, sizeof(PassUniforms), &setup.uniforms);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, kPassBinding, *pass_buffer);
    targets.begin_geometry();
    SurfacePass pass(gl, programs, textures, counters, has_emission());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      pass.note_id(static_cast<std::uint16_t>(std::min<std::size_t>(i + 2, 65535)));
      if (meshes[i]->visible && meshes[i]->has_positions()) pass.draw_body(*meshes[i]);
    }
    pass.note_id(1);
    if (environment.ground.visible) pass.draw_ground(*ground, environment.ground.look);
    std::vector<glm::uvec4> words;
    std::vector<float> depth;
    targets.read_geometry(words, depth);
    return channels_from_words(words, depth, options.width, options.height, setup.uniforms.clip_from_world,
                               picture.camera);
  }

  /// `half`: sum of the first half of the passes, `sum`: of all `passes`.
  double error_of(const FloatImage& half, const FloatImage& sum, int passes, const Environment& environment) const {
    const float weight = 2.0f / static_cast<float>(passes);
    FloatImage first = half, second = sum;
    const auto means = [&](std::vector<glm::vec4>& of_first, std::vector<glm::vec4>& of_second) {
      for (std::size_t i = 0; i < of_first.size(); ++i) {
        of_second[i] = weight * (of_second[i] - of_first[i]);
        of_first[i] *= weight;
      }
    };
    means(first.rgba, second.rgba);
    means(first.display, second.display);
    return halves_error(first, second, environment);
  }

  PictureSetup set_up(const Camera& camera, std::span<const Light> lights, const Environment& environment) {
    std::vector<Bounds> casters;
    for (const GpuMesh* mesh : drawn())
      if (mesh->casts_shadow) casters.push_back(mesh->world_bounds());
    Bounds seen = world_bounds();
    if (environment.ground.visible) seen.add(ground->world_bounds());
    PictureSetup picture = set_up_picture(fit_near_far(camera, seen), lights, environment, std::move(casters));
    picture.width = options.width;
    picture.height = options.height;
    picture.passes = options.tolerance > 0 ? std::min(options.samples, kFirstPasses) : options.samples;
    picture.shadow_map_size = shadow_map_size(options);
    return picture;
  }
};

Renderer::Renderer(const RenderOptions& options) {
  check_options(options);
  state_ = std::make_unique<State>(options);
}

Renderer::~Renderer() {
  // Names are deleted in the context that they belong to.
  if (state_) state_->context.make_current();
}

MeshId Renderer::add_mesh(SurfaceMesh mesh, std::vector<Look> looks) {
  check_mesh(mesh, looks.size());
  state_->context.make_current();
  for (const Look& look : looks)
    if (look.color_map && *look.color_map >= color_maps().size())
      throw std::invalid_argument(fmt::format("colour map {} of {}", *look.color_map, color_maps().size()));
  state_->meshes.push_back(std::make_unique<GpuMesh>(state_->gl, std::move(mesh), std::move(looks)));
  return state_->meshes.size() - 1;
}

MeshId Renderer::add_shape(Shape shape, const Look& look) {
  const std::vector<glm::vec3> positions = std::move(shape.positions);
  const MeshId id = add_mesh(std::move(shape.mesh), {look});
  set_positions(id, positions);
  return id;
}

void Renderer::set_positions(MeshId mesh, std::span<const glm::vec3> positions) {
  state_->mesh(mesh).set_positions(positions);
}

void Renderer::set_values(MeshId mesh, std::span<const float> values) { state_->mesh(mesh).set_values(values); }

void Renderer::set_transform(MeshId mesh, const glm::mat4& world_from_mesh) {
  state_->mesh(mesh).world_from_mesh = world_from_mesh;
}

void Renderer::set_visible(MeshId mesh, bool visible) { state_->mesh(mesh).visible = visible; }

void Renderer::set_casts_shadow(MeshId mesh, bool casts) { state_->mesh(mesh).casts_shadow = casts; }

void Renderer::set_seed(std::uint32_t seed) { state_->options.seed = seed; }

Bounds Renderer::bounds() const { return state_->world_bounds(); }

FloatImage Renderer::render_linear(const Camera& camera, std::span<const Light> lights, const Environment& environment,
                                   const Shutter& shutter) {
  State& s = *state_;
  s.context.make_current();
  if (environment.ground.visible) s.prepare_ground(environment.ground);
  PictureSetup picture;
  const auto set_up = [&](const Camera& seen_by) {
    s.upload_changes();
    picture = s.set_up(seen_by, lights, environment);
    s.prepare_shadow_maps(picture.shadow_maps);
  };
  std::vector<Light> all_lights(lights.begin(), lights.end());
  if (environment.panorama && environment.panorama->sun()) all_lights.push_back(*environment.panorama->sun());
  lights = all_lights;
  if (!shutter) set_up(camera);
  const std::vector<PassSample> samples = pass_samples(s.options.samples, lights.size(), s.options.seed);
  const bool measured = s.options.tolerance > 0 && s.options.samples > 1;
  s.report = {s.options.samples, {}};
  FloatImage half;  // of the last doubling, a sum
  int next_look = kFirstPasses / 2;
  for (int pass = 0; pass < s.options.samples; ++pass) {
    const PassSample& sample = samples[static_cast<std::size_t>(pass)];
    if (shutter) set_up(shutter(sample.time));
    // Each doubling adds passes that stand for smaller parts of the lights.
    if (measured) picture.passes = std::min(std::max(kFirstPasses, 2 * next_look), s.options.samples);
    s.draw_pass(picture, environment, sample, pass);
    const int drawn = pass + 1;
    if (!measured || drawn != next_look) continue;
    next_look *= 2;
    FloatImage sum = s.targets.read(1);
    if (!half.rgba.empty()) {
      s.report.samples = drawn;
      s.report.error = s.error_of(half, sum, drawn, environment);
      if (*s.report.error <= s.options.tolerance) break;
      s.report.samples = s.options.samples;
    }
    half = std::move(sum);
  }
  return s.targets.read(1.0f / static_cast<float>(s.report.samples));
}

Image Renderer::render(const Camera& camera, std::span<const Light> lights, const Environment& environment,
                       const Shutter& shutter) {
  if (shutter) return develop(render_linear(camera, lights, environment, shutter), environment);
  State& s = *state_;
  PictureInputs inputs = s.inputs(camera, lights, environment);
  if (s.last_picture && s.last_picture->inputs == inputs) {
    ++s.counters.pictures_reused;
    s.report = s.last_picture->report;
    return s.last_picture->picture;
  }
  Image picture = develop(render_linear(camera, lights, environment), environment);
  s.last_picture = {std::move(inputs), picture, s.report};
  return picture;
}

Channels Renderer::render_channels(const Camera& camera, const Environment& environment) {
  State& s = *state_;
  s.context.make_current();
  s.upload_changes();
  if (environment.ground.visible) s.prepare_ground(environment.ground);
  return s.channels(s.set_up(camera, {}, environment), environment);
}

const PictureReport& Renderer::last_picture() const { return state_->report; }

const RenderOptions& Renderer::options() const { return state_->options; }

const RenderCounters& Renderer::counters() const { return state_->counters; }

std::string Renderer::driver() const {
  state_->context.make_current();
  const auto text = [&](GLenum name) {
    const GLubyte* bytes = state_->gl.GetString(name);
    return std::string(bytes != nullptr ? reinterpret_cast<const char*>(bytes) : "unknown");
  };
  const std::string version = text(GL_VERSION);
  const std::size_t mesa = version.find("Mesa");
  return fmt::format("{}, {}", mesa == std::string::npos ? version : version.substr(mesa), text(GL_RENDERER));
}

}  // namespace softreel::render
