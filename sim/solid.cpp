#include "sim/solid.h"

#include <Eigen/LU>
#include <array>
#include <stdexcept>
#include <string>

#include "sim/materials/corotated.h"
#include "sim/materials/corotated_det.h"
#include "sim/materials/corotated_volume.h"
#include "sim/materials/linear.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stvk.h"
#include "sim/method_table.h"
#include "sim/simplex_kernel.h"

namespace softreel::sim {
namespace {

template <class Material>
std::unique_ptr<EnergyTerm> make(const Lame& lame, const TetMesh& mesh, int first_vertex) {
  using Kernel = SimplexKernel<Material, 3>;
  Kernel kernel{Material(lame), {}};
  kernel.rest.reserve(mesh.tets.size());
  std::vector<int> stencils;
  stencils.reserve(mesh.tets.size() * 4);
  for (const Tet& t : mesh.tets) {
    std::array<Vec3, 4> X;
    for (size_t a = 0; a < 4; ++a) {
      X[a] = mesh.vertices[static_cast<size_t>(t[a])];
      stencils.push_back(first_vertex + t[a]);
    }
    Eigen::Matrix3d Dm;
    Dm << X[1] - X[0], X[2] - X[0], X[3] - X[0];
    const double volume = Dm.determinant() / 6;
    if (!(volume > 0)) throw std::invalid_argument("tetrahedron without positive rest volume");
    kernel.rest.push_back({Dm.inverse(), volume});
  }
  return std::make_unique<ElementTerm<Kernel>>("solid", EnergyKind::kElastic, std::move(stencils), std::move(kernel));
}

struct Entry {
  MethodInfo info;
  MaterialTraits traits;
  std::unique_ptr<EnergyTerm> (*make)(const Lame&, const TetMesh&, int);
};

template <class Material>
constexpr Entry entry(const MethodInfo& info) {
  return {info, Material::kTraits, make<Material>};
}

// The one table of solid materials: a new one is its header and an entry here.
constexpr std::array kMaterials = {
    entry<StableNeoHookean<3>>({"stable-neo-hookean", "rubber and flesh; stands inversion, flattening and collapse",
                                "forces in closed form; SVD for the Hessian", "Smith, de Goes, Kim 2018, section 3.4"}),
    entry<CorotatedVolume<3>>(
        {"corotated-volume", "linear elasticity in the rotated frame, volume by its trace; stands inversion",
         "a polar rotation for forces; SVD for the Hessian", "Sifakis, Barbic 2012, section 3.4"}),
    entry<CorotatedDet<3>>(
        {"corotated-det", "as corotated-volume with the true change of volume; an inverted element may stay so",
         "a polar rotation for forces; SVD for the Hessian", "Stomakhin, Howes, Schroeder, Teran 2012, section 3.4"}),
    entry<Corotated<3>>({"corotated", "shape without volume: Poisson's ratio 0, whatever is given; stands inversion",
                         "a polar rotation for forces; SVD for the Hessian", "Kim, Eberle 2022, section 3.4"}),
    entry<Stvk<3>>({"stvk", "large rotations, small strain; gives way under strong compression and stays inverted",
                    "forces in closed form; SVD for the Hessian", "Ciarlet 1988, section 3.9"}),
    entry<Linear>({"linear", "small displacements only: a body that turns swells, for it is not rotation invariant",
                   "the cheapest: the Hessian never changes", "Sifakis, Barbic 2012, section 3.2"}),
};

}  // namespace

Catalogue solid_materials() { return catalogue_of<kMaterials>(); }

const MaterialTraits& solid_traits(std::string_view material) {
  return find_method(kMaterials, material, "solid material").traits;
}

std::unique_ptr<EnergyTerm> make_solid(std::string_view material, double young, double poisson, const TetMesh& rest,
                                       int first_vertex) {
  return find_method(kMaterials, material, "solid material").make(solid_lame(young, poisson), rest, first_vertex);
}

std::vector<double> lumped_masses(const TetMesh& rest, double density) {
  std::vector<double> masses(rest.vertices.size(), 0.0);
  for (const Tet& t : rest.tets) {
    const auto vertex = [&](size_t a) { return rest.vertices[static_cast<size_t>(t[a])]; };
    const double quarter = density * tet_volume(vertex(0), vertex(1), vertex(2), vertex(3)) / 4;
    for (int v : t) masses[static_cast<size_t>(v)] += quarter;
  }
  return masses;
}

}  // namespace softreel::sim
