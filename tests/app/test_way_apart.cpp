// Moving one body clear of another by the least translation.
#include <doctest/doctest.h>

#include <vector>

#include "app/way_apart.h"
#include "sim/grids.h"
#include "sim/motion.h"

using namespace softreel;
using sim::Vec3;

namespace {

std::vector<Vec3> cube(const Eigen::Matrix3d& R, const Vec3& middle) {
  std::vector<Vec3> points = sim::block_of_tets(Vec3::Ones(), 1, 1, 1).vertices;
  for (Vec3& p : points) p = R * p + middle;
  return points;
}

}  // namespace

TEST_CASE("turned boxes part along the normal of the faces that overlap, and not along an axis") {
  const Eigen::Matrix3d R = sim::euler_xyz({30, 20, 45});
  const std::vector<Vec3> normals{R.col(0), R.col(1), R.col(2)};
  const double gap = 0.01;
  for (const Vec3& n : normals)
    for (const double side : {1.0, -1.0}) {
      const std::vector<Vec3> other = cube(R, Vec3(1, 2, 3)), own = cube(R, Vec3(1, 2, 3) + side * 0.9 * n);
      const Vec3 way = app::way_apart(own, other, normals, gap);
      CHECK((way - side * (0.1 + gap) * n).norm() < 1e-12);
      CHECK(app::way_apart(own, other, {}, gap).norm() > 2 * way.norm());
    }
}

TEST_CASE("of ways of one length the one up is taken, and none where bodies are apart") {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  CHECK((app::way_apart(cube(I, Vec3::Zero()), cube(I, Vec3::Zero()), {}, 0) - Vec3(0, 1, 0)).norm() < 1e-12);
  CHECK(app::way_apart(cube(I, Vec3(3, 0, 0)), cube(I, Vec3::Zero()), {}, 0.1).isZero(0));
}
