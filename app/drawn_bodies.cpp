#include "app/drawn_bodies.h"

#include "app/convert.h"

namespace softreel::app {

render::Shape shape_of(const assets::Collider& c, float side) {
  const float scale = static_cast<float>(c.transform.scale.x());
  switch (c.shape) {
    case assets::ColliderShape::kSphere:
      return render::make_sphere(static_cast<float>(c.radius) * scale);
    case assets::ColliderShape::kBox:
      return render::make_box(to_glm(Eigen::Vector3d(c.transform.scale.cwiseProduct(c.size))));
    case assets::ColliderShape::kCapsule:
      return render::make_capsule(static_cast<float>(c.radius) * scale, static_cast<float>(c.height) * scale);
    case assets::ColliderShape::kPlane:
    case assets::ColliderShape::kMesh:
      break;
  }
  return render::make_plane(side, side);
}

}  // namespace softreel::app
