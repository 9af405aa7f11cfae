#pragma once
// The camera, and where to put it when the scene does not say.
#include <glm/glm.hpp>
#include <span>

#include "render/bounds.h"

namespace softreel::render {

/// Camera in world space, right-handed, looking from `position` to `target`.
struct Camera {
  glm::vec3 position{3, 2, 4};   ///< [m]
  glm::vec3 target{0, 0.5f, 0};  ///< [m]
  glm::vec3 up{0, 1, 0};
  float fov = 40;      ///< vertical opening [degrees], 0 < fov < 180
  float near = 0;      ///< [m]; 0: fitted to what is drawn
  float far = 0;       ///< [m]; 0: fitted to what is drawn
  float height = 0;    ///< orthographic: what the picture's height covers [m]; 0: perspective, by `fov`
  float aperture = 0;  ///< diameter of the thin lens [m]; 0: a pinhole, everything is sharp. Perspective only
  float focus = 0;     ///< distance along the view at which things are sharp [m]; 0: that of `target`
  bool orthographic() const { return height > 0; }
  bool operator==(const Camera&) const = default;
};

glm::mat4 camera_from_world(const Camera& camera);
/// OpenGL clip space (z from -w to w). `aspect` = width / height. Needs camera.near and camera.far set.
glm::mat4 clip_from_camera(const Camera& camera, float aspect);
/// The same camera with near and far set (where they are 0) so that `bounds` is inside.
Camera fit_near_far(Camera camera, const Bounds& bounds);

/// From the target towards the camera: three-quarter view from slightly above. Unit length.
glm::vec3 default_view_direction();

/// Camera that sees all of `points` (world, over the whole clip) as large as possible with `margin` (part of the half
/// picture left free on the tightest side, 0 <= margin < 1), looking along -`direction`. Exact for the points: the
/// smallest distance at which all lie in the frustum. Empty points: the unit box. Throws std::invalid_argument for fov,
/// aspect, margin or direction out of range.
Camera frame_points(std::span<const glm::vec3> points, float fov, float aspect,
                    const glm::vec3& direction = default_view_direction(), float margin = 0.08f);
/// The same for an orthographic camera: the least `height` that holds all points.
Camera frame_points_orthographic(std::span<const glm::vec3> points, float aspect,
                                 const glm::vec3& direction = default_view_direction(), float margin = 0.08f);
/// The camera with its eye at `disc` (unit disc) of the lens, still looking straight ahead; `shear` goes onto the
/// projection so that what lies in focus stays where it is.
struct LensView {
  Camera camera;
  glm::vec2 shear{0};  ///< tangents, right and up: x_clip += shear * depth, before the scale of the projection
};
LensView through_lens(const Camera& camera, const glm::vec2& disc);
/// The same for the corners of a box.
Camera frame_bounds(const Bounds& bounds, float fov, float aspect,
                    const glm::vec3& direction = default_view_direction(), float margin = 0.08f);

/// Camera that sees all of `points` (at rest) at every angle while the mesh turns about the vertical axis through
/// `axis` (y is not used), or while the camera goes round it.
Camera frame_turntable(std::span<const glm::vec3> points, const glm::vec3& axis, float fov, float aspect,
                       const glm::vec3& direction = default_view_direction(), float margin = 0.08f);
/// The camera turned about the vertical axis through `axis` by `angle` [degrees], counter-clockwise seen from above.
Camera orbit(const Camera& camera, const glm::vec3& axis, float angle);

}  // namespace softreel::render
