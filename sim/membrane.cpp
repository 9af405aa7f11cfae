#include "sim/membrane.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <stdexcept>
#include <string>

#include "sim/materials/corotated.h"
#include "sim/materials/corotated_det.h"
#include "sim/materials/corotated_volume.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stvk.h"
#include "sim/method_table.h"
#include "sim/simplex_kernel.h"

namespace softreel::sim {
namespace {

template <class Material>
std::unique_ptr<EnergyTerm> make(const Lame& lame, double thickness, const TriangleMesh& mesh, int first_vertex) {
  using Kernel = SimplexKernel<Material, 2>;
  Kernel kernel{Material(lame), {}};
  kernel.rest.reserve(mesh.triangles.size());
  std::vector<int> stencils;
  stencils.reserve(mesh.triangles.size() * 3);
  for (const Triangle& t : mesh.triangles) {
    for (int v : t) stencils.push_back(first_vertex + v);
    const Vec3& origin = mesh.vertices[static_cast<size_t>(t[0])];
    const Vec3 e1 = mesh.vertices[static_cast<size_t>(t[1])] - origin;
    const Vec3 e2 = mesh.vertices[static_cast<size_t>(t[2])] - origin;
    const Vec3 normal = e1.cross(e2);
    if (!(normal.norm() > 0)) throw std::invalid_argument("triangle without area");
    const Vec3 axis = e1.normalized();
    const Vec3 across = normal.cross(e1).normalized();
    Eigen::Matrix2d Dm;
    Dm << axis.dot(e1), axis.dot(e2), 0, across.dot(e2);
    kernel.rest.push_back({Dm.inverse(), 0.5 * normal.norm() * thickness});
  }
  return std::make_unique<ElementTerm<Kernel>>("membrane", EnergyKind::kElastic, std::move(stencils),
                                               std::move(kernel));
}

struct Entry {
  MethodInfo info;
  MaterialTraits traits;
  std::unique_ptr<EnergyTerm> (*make)(const Lame&, double, const TriangleMesh&, int);
};

template <class Material>
constexpr Entry entry(const MethodInfo& info) {
  return {info, Material::kTraits, make<Material>};
}

// The one table of surface materials: a new one is its header and an entry here. Without "linear": a sheet leaves its
// plane and turns, and linear strain has neither a force out of the plane nor rotations.
constexpr std::array kMaterials = {
    entry<Stvk<2>>({"stvk", "cloth; gives way under strong compression",
                    "forces in closed form; 3x2 SVD for the Hessian", "Ciarlet 1988, section 3.9, in plane stress"}),
    entry<StableNeoHookean<2>>({"stable-neo-hookean", "rubber sheet; large stretches, stands collapse",
                                "forces in closed form; 3x2 SVD for the Hessian",
                                "after Smith, de Goes, Kim 2018, in plane stress"}),
    entry<CorotatedVolume<2>>({"corotated-volume", "linear in the stretches at any rotation, area by their sum",
                               "forces in closed form; 3x2 SVD for the Hessian",
                               "Sifakis, Barbic 2012, section 3.4, in plane stress"}),
    entry<CorotatedDet<2>>({"corotated-det", "as corotated-volume with the true change of area",
                            "forces in closed form; 3x2 SVD for the Hessian",
                            "Stomakhin, Howes, Schroeder, Teran 2012, section 3.4, in plane stress"}),
    entry<Corotated<2>>({"corotated", "shape without area: Poisson's ratio 0, whatever is given",
                         "forces in closed form; 3x2 SVD for the Hessian", "Kim, Eberle 2022, section 3.4"}),
};

}  // namespace

Catalogue membrane_materials() { return catalogue_of<kMaterials>(); }

const MaterialTraits& membrane_traits(std::string_view material) {
  return find_method(kMaterials, material, "membrane material").traits;
}

std::unique_ptr<EnergyTerm> make_membrane(std::string_view material, double young, double poisson, double thickness,
                                          const TriangleMesh& rest, int first_vertex) {
  return find_method(kMaterials, material, "membrane material")
      .make(surface_lame(young, poisson), thickness, rest, first_vertex);
}

std::vector<double> lumped_masses(const TriangleMesh& rest, double areal_density) {
  std::vector<double> masses(rest.vertices.size(), 0.0);
  for (const Triangle& t : rest.triangles) {
    const auto vertex = [&](size_t a) { return rest.vertices[static_cast<size_t>(t[a])]; };
    const double third = areal_density * 0.5 * (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).norm() / 3;
    for (int v : t) masses[static_cast<size_t>(v)] += third;
  }
  return masses;
}

}  // namespace softreel::sim
