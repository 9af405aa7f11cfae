#include "app/convert.h"

namespace softreel::app {

std::vector<glm::vec3> points_of(const Eigen::VectorXd& x, int first, int count) {
  std::vector<glm::vec3> points;
  points.reserve(static_cast<size_t>(count));
  for (int i = first; i < first + count; ++i) points.push_back(to_glm(Eigen::Vector3d(x.segment<3>(3 * i))));
  return points;
}

}  // namespace softreel::app
