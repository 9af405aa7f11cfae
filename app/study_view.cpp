#include "app/study_view.h"

#include <cmath>
#include <limits>

#include "app/scene_camera.h"
#include "render/camera.h"

namespace softreel::app {

StudyView::StudyView(const assets::Scene& scene, const ClipExtent& extent)
    : width_(scene.render.size[0]), height_(scene.render.size[1]) {
  render::Camera camera = camera_of(scene, extent);
  camera.near = 1;  // depth is not looked at
  camera.far = 2;
  clip_from_world_ = glm::dmat4(render::clip_from_camera(camera, static_cast<float>(width_ / height_))) *
                     glm::dmat4(render::camera_from_world(camera));
}

double StudyView::apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  const glm::dvec4 p = clip_from_world_ * glm::dvec4(a.x(), a.y(), a.z(), 1);
  const glm::dvec4 q = clip_from_world_ * glm::dvec4(b.x(), b.y(), b.z(), 1);
  const bool before_a = p.w > 0, before_b = q.w > 0;
  if (!before_a && !before_b) return 0;
  if (!before_a || !before_b) return std::numeric_limits<double>::infinity();
  return std::hypot((p.x / p.w - q.x / q.w) * width_ / 2, (p.y / p.w - q.y / q.w) * height_ / 2);
}

}  // namespace softreel::app
