#include "app/study_closed_form.h"

#include <fmt/format.h>

#include "app/clip_world.h"
#include "assets/error.h"
#include "assets/formula.h"

namespace softreel::app {

void evaluate_closed_form(const StudyPoints& points, const Shapes& shapes, StudyReference& reference) {
  const assets::Scene& scene = reference.scene;
  const assets::Reference& description = *scene.reference;
  const assets::Formula x(description.x), y(description.y), z(description.z);
  const auto refuse = [&](const std::string& why) {
    throw assets::UserError(assets::ErrorKind::kUsage, scene.file.string(), "reference: " + why);
  };
  CachedFrame frame = ClipWorld(scene, shapes).frame({});
  const StudyPoints::Body& body = points.bodies.front();
  for (int f = 0; f < scene.time.frames(); ++f) {
    const double t = f / scene.time.fps;
    frame.state.t = t;
    Eigen::Matrix3Xd where(3, static_cast<Eigen::Index>(body.rest.size()));
    for (size_t i = 0; i < body.rest.size(); ++i) {
      const sim::Vec3& rest = body.rest[i];
      const sim::Vec3 u(x(rest, t), y(rest, t), z(rest, t));
      if (!u.allFinite())
        refuse(fmt::format("no finite displacement at ({:.4g}, {:.4g}, {:.4g}) [m], t = {:.4g} s", rest.x(), rest.y(),
                           rest.z(), t));
      if (f == 0 && u.norm() > 1e-9 * reference.size)
        refuse(
            fmt::format("at t = 0 the displacement of vertex {} is ({:.4g}, {:.4g}, {:.4g}) m, and every body starts "
                        "where it was put; subtract it from the formulas",
                        i, u.x(), u.y(), u.z()));
      where.col(static_cast<Eigen::Index>(i)) = rest + u;
      frame.state.x.segment<3>(3 * (body.first + static_cast<int>(i))) = rest + u;
    }
    reference.points.push_back(std::move(where));
    reference.frames.push_back(frame);
  }
}

}  // namespace softreel::app
