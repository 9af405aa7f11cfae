#pragma once
// Shapes as fields: negative inside, about the distance to the surface. Primitives and smooth unions after
// I. Quilez, "Distance functions", https://iquilezles.org/articles/distfunctions.
#include <Eigen/Core>
#include <functional>

namespace softreel::generate {

using Vec3 = Eigen::Vector3d;
using Field = std::function<double(const Vec3&)>;  ///< position [m] -> about signed distance [m]

double sphere(const Vec3& p, const Vec3& center, double radius);
double ellipsoid(const Vec3& p, const Vec3& center, const Vec3& radii);
/// A capsule whose radius goes from `ra` at `a` to `rb` at `b`.
double round_cone(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb);
double rounded_box(const Vec3& p, const Vec3& half, double radius);
/// Around the y axis.
double torus(const Vec3& p, double radius, double tube);

/// Minimum and maximum, rounded over the width `k` [m].
double smooth_union(double a, double b, double k);
double smooth_intersection(double a, double b, double k);

/// Gradient by central differences over 1e-5 m.
Vec3 gradient(const Field& field, const Vec3& p);
/// The nearest point of the surface, by Newton steps along the gradient.
Vec3 project(const Field& field, Vec3 p);

}  // namespace softreel::generate
