#pragma once
// The scene on stage: renderer, camera, lights and surroundings for a whole clip.
#include <memory>
#include <optional>
#include <vector>

#include "app/clip_cache.h"
#include "app/drawn_field.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "render/environment.h"
#include "render/renderer.h"
#include "sim/collider.h"

namespace softreel::app {

/// Whether camera, ground, lights or the range of a field are placed by what the whole clip covers, so that it has to
/// be simulated before its first picture.
bool needs_whole_clip(const assets::Scene& scene);

/// What the visible things cover over the frames that were added.
struct ClipExtent {
  render::Bounds bounds;                 ///< of bodies and colliders with an end
  std::vector<FieldRange> field_ranges;  ///< as scene.fields
  std::vector<glm::vec3> points;         ///< corners of the boxes around each of them in each frame, for framing

  void add(const render::Bounds& box);
};

/// The visible bodies, fields and colliders of one frame.
void add_frame(const assets::Scene& scene, const Shapes& shapes, const CachedFrame& frame, ClipExtent& extent);

class Stage {
 public:
  /// Builds meshes and looks; camera, ground and lights from `extent` where the scene leaves them open. `scene` and
  /// `shapes` must outlive this.
  Stage(const assets::Scene& scene, const Shapes& shapes, const ClipExtent& extent);

  /// The picture of frame `number`. `before`: the frame before it, where there is one; used when the shutter is open.
  render::Image draw(int number, const CachedFrame& frame, const CachedFrame* before);
  const render::Renderer& renderer() const { return renderer_; }

 private:
  void add_bodies(const Shapes& shapes);
  void add_fields(const Shapes& shapes, const ClipExtent& extent);
  void add_colliders(const ClipExtent& extent);
  void place_lights(const ClipExtent& extent);
  void place_ground(const ClipExtent& extent);
  void move_to(const CachedFrame& frame);

  struct DrawnBody {
    render::MeshId mesh;
    int first = 0, count = 0;  // vertices of the state
  };
  struct DrawnNet {
    render::MeshId mesh;
    int first = 0;  // vertex of the state
    const BallsAndRods* shape = nullptr;
  };
  struct DrawnField {
    render::MeshId mesh;
    FieldSurface surface;
    std::array<double, 2> range;
  };
  struct DrawnCollider {
    render::MeshId mesh;
    sim::Collider collider;
    bool moves = false;
  };

  const assets::Scene& scene_;
  render::Renderer renderer_;
  std::vector<DrawnBody> bodies_;
  std::vector<DrawnNet> nets_;
  std::vector<DrawnField> fields_;
  std::vector<render::ColorBar> bars_;
  std::vector<DrawnCollider> colliders_;
  const assets::Collider* ground_plane_ = nullptr;  // a plane collider that is drawn as the ground
  render::Camera camera_;
  std::vector<render::Light> lights_;
  render::Environment environment_;
};

}  // namespace softreel::app
