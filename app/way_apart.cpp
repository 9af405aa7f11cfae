#include "app/way_apart.h"

#include <algorithm>
#include <limits>

namespace softreel::app {

using sim::Vec3;

Vec3 way_apart(std::span<const Vec3> own, std::span<const Vec3> other, std::span<const Vec3> directions, double gap) {
  constexpr double kUnlessUp = 1.001;  // what is as short within this is not preferred to the way up
  Vec3 best = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Vec3& direction) {
    if (!(direction.squaredNorm() > 0)) return;
    const Vec3 n = direction.normalized();
    double top = -std::numeric_limits<double>::infinity(), bottom = -top;
    for (const Vec3& p : other) top = std::max(top, n.dot(p));
    for (const Vec3& p : own) bottom = std::min(bottom, n.dot(p));
    const double length = std::max(0.0, top + gap - bottom);
    const double price = length * (n.y() > 0.999 ? 1 : kUnlessUp);
    if (price >= least) return;
    least = price;
    best = length * n;
  };
  for (const int axis : {1, 0, 2})
    for (const double side : {1.0, -1.0}) look(side * Vec3::Unit(axis));
  for (const Vec3& direction : directions) {
    look(direction);
    look(-direction);
  }
  return best;
}

}  // namespace softreel::app
