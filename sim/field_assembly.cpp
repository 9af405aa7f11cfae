#include "sim/field_assembly.h"

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "sim/parallel.h"

namespace softreel::sim {
namespace {

using Triplet = Eigen::Triplet<double>;

std::array<Vec3, 3> corners(const TriangleMesh& mesh, int triangle) {
  const Triangle& t = mesh.triangles[static_cast<size_t>(triangle)];
  return {mesh.vertices[static_cast<size_t>(t[0])], mesh.vertices[static_cast<size_t>(t[1])],
          mesh.vertices[static_cast<size_t>(t[2])]};
}

double area_of(const std::array<Vec3, 3>& p) { return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm(); }

/// Calls add(i, j, value) of every element for its nine pairs; the sums are formed in this order.
template <class Entry>
ScalarMatrix assemble(const TriangleMesh& mesh, const Entry& entry) {
  const auto n = static_cast<int>(mesh.vertices.size());
  std::vector<Triplet> triplets;
  triplets.reserve(9 * mesh.triangles.size());
  for (size_t e = 0; e < mesh.triangles.size(); ++e) {
    const HatTriangle hats = hat_triangle(mesh, static_cast<int>(e));
    for (size_t a = 0; a < 3; ++a)
      for (size_t b = 0; b < 3; ++b)
        triplets.emplace_back(mesh.triangles[e][a], mesh.triangles[e][b], entry(hats, a, b));
  }
  ScalarMatrix matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

HatTriangle hat_triangle(const TriangleMesh& mesh, int triangle) {
  const std::array<Vec3, 3> p = corners(mesh, triangle);
  const Vec3 cross = (p[1] - p[0]).cross(p[2] - p[0]);
  const double twice = cross.norm();
  const double longest =
      std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
  // Below that the direction of the normal is rounding.
  if (!(twice > 1e-12 * longest)) throw std::invalid_argument("triangle " + std::to_string(triangle) + " has no area");
  const Vec3 normal = cross / twice;
  HatTriangle hats;
  hats.area = 0.5 * twice;
  // N_a falls from 1 to 0 over the height above the edge that faces vertex a.
  for (size_t a = 0; a < 3; ++a) hats.gradient[a] = normal.cross(p[(a + 2) % 3] - p[(a + 1) % 3]) / twice;
  return hats;
}

ScalarMatrix assemble_stiffness(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (int v : t) used[static_cast<size_t>(v)] = true;
  for (size_t v = 0; v < used.size(); ++v)
    if (!used[v]) throw std::invalid_argument("vertex " + std::to_string(v) + " belongs to no triangle");
  return assemble(mesh, [](const HatTriangle& hats, size_t a, size_t b) {
    return hats.area * hats.gradient[a].dot(hats.gradient[b]);
  });
}

ScalarMatrix assemble_mass(const TriangleMesh& mesh, FieldMass mass) {
  if (mass == FieldMass::kConsistent)
    return assemble(mesh, [](const HatTriangle& hats, size_t a, size_t b) { return hats.area / (a == b ? 6 : 12); });
  const auto n = static_cast<int>(mesh.vertices.size());
  Eigen::VectorXd lumped = Eigen::VectorXd::Zero(n);
  for (size_t e = 0; e < mesh.triangles.size(); ++e)
    for (int v : mesh.triangles[e]) lumped(v) += area_of(corners(mesh, static_cast<int>(e))) / 3;
  ScalarMatrix matrix(n, n);
  matrix.reserve(Eigen::VectorXi::Constant(n, 1));
  for (int i = 0; i < n; ++i) matrix.insert(i, i) = lumped(i);
  matrix.makeCompressed();
  return matrix;
}

void assemble_load(const TriangleMesh& mesh, const FieldFunction& f, double t, Eigen::VectorXd& load) {
  load.setZero(static_cast<Eigen::Index>(mesh.vertices.size()));
  if (!f.value) return;
  std::vector<double> share(mesh.triangles.size());
  parallel_for(static_cast<int>(share.size()), Work::kRow, [&](int e) {
    const std::array<Vec3, 3> p = corners(mesh, e);
    share[static_cast<size_t>(e)] = area_of(p) / 3 * f((p[0] + p[1] + p[2]) / 3, t);
  });
  for (size_t e = 0; e < share.size(); ++e)
    for (int v : mesh.triangles[e]) load(v) += share[e];
}

void multiply(const ScalarMatrix& A, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  y.resize(A.rows());
  const int* start = A.outerIndexPtr();
  const int* column = A.innerIndexPtr();
  const double* value = A.valuePtr();
  parallel_for(static_cast<int>(A.rows()), Work::kVector, [&](int i) {
    double sum = 0;
    for (int k = start[i]; k < start[i + 1]; ++k) sum += value[k] * x(column[k]);
    y(i) = sum;
  });
}

}  // namespace softreel::sim
