#pragma once
// The scene on stage: renderer, camera, lights and surroundings for a whole clip.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/clip_extent.h"
#include "app/shapes.h"
#include "assets/scene.h"
#include "render/environment.h"
#include "render/renderer.h"
#include "sim/collider.h"

namespace softreel::app {

class Stage {
 public:
  /// Builds meshes and looks; camera, ground and lights from `extent` where the scene leaves them open. `scene` and
  /// `shapes` must outlive this.
  Stage(const assets::Scene& scene, const Shapes& shapes, const ClipExtent& extent);

  /// The picture of frame `number`. `before`: the frame before it, where there is one; used when the shutter is open.
  render::Image draw(int number, const CachedFrame& frame, const CachedFrame* before);
  /// The same before tone curve, background and colour bars, with everything standing still.
  render::FloatImage draw_linear(const CachedFrame& frame);
  /// The frame as a camera of one's own sees it.
  render::Image draw_from(const CachedFrame& frame, const render::Camera& camera);
  /// Depth, normals and ids of what the last picture shows.
  render::Channels channels();
  const render::Renderer& renderer() const { return renderer_; }
  /// What the user should know of the files that the picture takes.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void add_bodies(const Shapes& shapes, const ClipExtent& extent);
  void add_fields(const Shapes& shapes, const ClipExtent& extent);
  void add_colliders(const Shapes& shapes, const ClipExtent& extent);
  void place_lights(const ClipExtent& extent);
  void place_ground(const ClipExtent& extent);
  void move_to(const CachedFrame& frame);
  render::Camera camera_now(const CachedFrame& frame) const;
  void find_followed(const Shapes& shapes);

  struct DrawnBody {
    render::MeshId mesh;
    int first = 0, count = 0;  // vertices of the state
    std::shared_ptr<const BodyFigure> figure = nullptr;
    std::array<double, 2> range{0, 1};
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
  int followed_first_ = 0, followed_count_ = 0;  // vertices of the state; 0: the camera follows nothing
  glm::vec3 followed_start_{0};                  // their mean at t = 0
  std::vector<render::Light> lights_;
  render::Environment environment_;
  std::vector<std::string> notes_;
  render::Camera last_camera_;
};

}  // namespace softreel::app
