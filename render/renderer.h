#pragma once
// Draws meshes with OSMesa into pictures. One Renderer is one GL context; use it on the thread that made it.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/bounds.h"
#include "render/camera.h"
#include "render/channels.h"
#include "render/counters.h"
#include "render/environment.h"
#include "render/film.h"
#include "render/image.h"
#include "render/light.h"
#include "render/look.h"
#include "render/surface_mesh.h"

namespace softreel::render {

struct RenderOptions {
  int width = 1280;        ///< [px], 1 .. 16384
  int height = 720;        ///< [px], 1 .. 16384
  int samples = 16;        ///< accumulation passes per picture, 1 .. 65536
  std::uint32_t seed = 0;  ///< of the sample sequence; the same for every frame, so that still parts do not flicker
  double tolerance = 0;  ///< > 0: passes until the estimated error (error_estimate.h) is below this [levels of 255], at
                         ///< least 8 and at most `samples`
  int shadow_map_size = 0;  ///< [texels]; 0: chosen from the picture's size
};

using MeshId = std::size_t;

/// Moves what moves while the shutter is open, to `time` (0 it opens .. 1 it closes), and says where the camera is
/// then.
using Shutter = std::function<Camera(float time)>;

/// How the last picture was made.
struct PictureReport {
  int samples = 0;
  std::optional<double> error;  ///< estimated, RMS [levels of 255]; only with a tolerance
};

class Renderer {
 public:
  /// Throws RenderError (kContext) when no context of the needed version can be made, std::invalid_argument for options
  /// out of range.
  explicit Renderer(const RenderOptions& options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Adds a surface. `looks`: as many as its parts name, at least one. Nothing is drawn of it until set_positions.
  /// Throws std::invalid_argument as check_mesh does.
  MeshId add_mesh(SurfaceMesh mesh, std::vector<Look> looks);
  /// A shape that keeps its positions.
  MeshId add_shape(Shape shape, const Look& look);

  /// New positions (position_count of them, mesh space [m]); normals follow from them. Uploaded with the next picture,
  /// and only when they differ from the last ones.
  void set_positions(MeshId mesh, std::span<const glm::vec3> positions);
  /// New values of a field, 0..1 of its colour map (position_count of them; beyond, the colours of the ends). All 0 at
  /// first. Throws std::invalid_argument for a mesh whose looks have no colour map.
  void set_values(MeshId mesh, std::span<const float> values);
  /// world_from_mesh for a mesh that moves as a whole (no upload). Rotation, translation and any scale but zero.
  void set_transform(MeshId mesh, const glm::mat4& world_from_mesh);
  void set_visible(MeshId mesh, bool visible);
  /// True at first. A ground quad need not cast.
  void set_casts_shadow(MeshId mesh, bool casts);

  /// Of the pictures from now on.
  void set_seed(std::uint32_t seed);

  /// Box around all visible meshes as they are now, world space.
  Bounds bounds() const;

  /// One picture. The same input gives the same bits on one machine, for any thread count; where nothing at all has
  /// changed since the picture before, seed included, that one is returned again. `shutter`: for motion blur,
  /// called before each pass; empty: everything stands still.
  Image render(const Camera& camera, std::span<const Light> lights, const Environment& environment,
               const Shutter& shutter = {});
  /// The same before tone curve and background: see film.h.
  FloatImage render_linear(const Camera& camera, std::span<const Light> lights, const Environment& environment,
                           const Shutter& shutter = {});
  const PictureReport& last_picture() const;
  /// What is seen in the middle of each pixel, as things stand now.
  Channels render_channels(const Camera& camera, const Environment& environment);

  const RenderOptions& options() const;
  const RenderCounters& counters() const;
  /// "Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)", for --version.
  std::string driver() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace softreel::render
