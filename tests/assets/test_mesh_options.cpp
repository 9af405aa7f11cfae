#include "assets/mesh_options.h"
#include "tests/assets/support.h"

using namespace softreel;

TEST_CASE("The up axis is turned onto y without mirroring") {
  for (const auto& [up, axis] : std::map<char, int>{{'x', 0}, {'y', 1}, {'z', 2}}) {
    const Eigen::Matrix3d turn = assets::y_from_up(up);
    CHECK(turn * sim::Vec3::Unit(axis) == sim::Vec3::UnitY());
    CHECK(turn.determinant() == doctest::Approx(1));
    CHECK((turn * turn.transpose()).isIdentity());
  }
}

TEST_CASE("Unit scales, and size sets the longest side whatever the unit") {
  std::vector<sim::Vec3> points = {{0, 0, 0}, {1, 2, 4}};
  assets::MeshOptions options;
  options.unit = *assets::metres_per_unit("cm");
  options.up = 'z';
  CHECK(assets::apply_mesh_options(options, points) == 0.01);
  CHECK(points[1].isApprox(sim::Vec3(0.01, 0.04, -0.02)));
  options = {};
  options.unit = 1000;
  options.size = 0.5;
  assets::apply_mesh_options(options, points);
  CHECK((points[1] - points[0]).cwiseAbs().maxCoeff() == doctest::Approx(0.5));
  CHECK(points[0] == sim::Vec3(0, 0, 0));
}

TEST_CASE("Unit names are known or nothing") {
  CHECK(assets::metres_per_unit("inch") == 0.0254);
  CHECK(assets::metres_per_unit("mm") == 1e-3);
  CHECK_FALSE(assets::metres_per_unit("furlong"));
}
