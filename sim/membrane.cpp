#include "sim/membrane.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <stdexcept>
#include <string>

#include "sim/element_term.h"
#include "sim/materials/stable_neo_hookean_surface.h"
#include "sim/materials/stvk_surface.h"
#include "sim/method_table.h"

namespace softreel::sim {
namespace {

template <class Material>
struct MembraneKernel {
  static constexpr int kCorners = 3;
  static constexpr bool kConstantHessian = false;

  Material material;
  struct Rest {
    Eigen::Matrix2d gradient;  // row a - 1: grad N_a in the triangle's plane [1/m], a = 1, 2
    double volume;             // area times thickness [m^3]
  };
  std::vector<Rest> rest;

  double energy(int e, const Corners<3>& X) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    return r.volume * material.psi(deformation(X, r));
  }

  void gradient(int e, const Corners<3>& X, Corners<3>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    out.rightCols<2>().noalias() = r.volume * material.pk1(deformation(X, r)) * r.gradient.transpose();
    out.col(0) = -(out.col(1) + out.col(2));
  }

  // As for the solid: the sum over d2psi/dF2 is taken in the principal frame.
  void hessian(int e, const Corners<3>& X, Definiteness definiteness, ElementHessian<3>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const Principal2 p = principal_stretches(deformation(X, r));
    PrincipalHessian2 h = material.hessian(p.sigma);
    if (definiteness == Definiteness::kClamped) clamp(h);
    const Eigen::Matrix2d b = p.V.transpose() * r.gradient.transpose();  // column a - 1
    const double same = 0.5 * (h.symmetric + h.antisymmetric);
    const double swapped = 0.5 * (h.symmetric - h.antisymmetric);
    for (int a = 0; a < 2; ++a) {
      for (int c = a; c < 2; ++c) {
        Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
        N(0, 0) = h.stretch(0, 0) * b(0, a) * b(0, c) + same * b(1, a) * b(1, c);
        N(1, 1) = h.stretch(1, 1) * b(1, a) * b(1, c) + same * b(0, a) * b(0, c);
        N(0, 1) = h.stretch(0, 1) * b(0, a) * b(1, c) + swapped * b(1, a) * b(0, c);
        N(1, 0) = h.stretch(1, 0) * b(1, a) * b(0, c) + swapped * b(0, a) * b(1, c);
        N(2, 2) = h.normal(0) * b(0, a) * b(0, c) + h.normal(1) * b(1, a) * b(1, c);
        const Eigen::Matrix3d K = r.volume * p.U * N * p.U.transpose();
        out.block<3, 3>(3 * (a + 1), 3 * (c + 1)) = K;
        if (a != c) out.block<3, 3>(3 * (c + 1), 3 * (a + 1)) = K.transpose();
      }
    }
    for (int a = 1; a < 3; ++a) {
      out.block<3, 3>(0, 3 * a) = -(out.block<3, 3>(3, 3 * a) + out.block<3, 3>(6, 3 * a));
      out.block<3, 3>(3 * a, 0) = out.block<3, 3>(0, 3 * a).transpose();
    }
    out.block<3, 3>(0, 0) = -(out.block<3, 3>(0, 3) + out.block<3, 3>(0, 6));
  }

 private:
  static Eigen::Matrix<double, 3, 2> deformation(const Corners<3>& X, const Rest& r) {
    Eigen::Matrix<double, 3, 2> Ds;
    Ds << X.col(1) - X.col(0), X.col(2) - X.col(0);
    return Ds * r.gradient;
  }
};

template <class Material>
std::unique_ptr<EnergyTerm> make(const Material& material, double thickness, const TriangleMesh& mesh,
                                 int first_vertex) {
  MembraneKernel<Material> kernel{material, {}};
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
  return std::make_unique<ElementTerm<MembraneKernel<Material>>>("membrane", EnergyKind::kElastic, std::move(stencils),
                                                                 std::move(kernel));
}

struct Entry {
  MethodInfo info;
  std::unique_ptr<EnergyTerm> (*make)(const Lame&, double, const TriangleMesh&, int);
};

template <class Material>
constexpr Entry entry(const MethodInfo& info) {
  return {info, [](const Lame& lame, double thickness, const TriangleMesh& mesh, int first) {
            return make(Material(lame), thickness, mesh, first);
          }};
}

// The one table of surface materials: a new one is its header and an entry here.
constexpr std::array kMaterials = {
    entry<StvkSurface>({"stvk", "cloth; weakens under strong compression", "no SVD for forces",
                        "Ciarlet 1988, section 3.9, in plane stress"}),
    entry<StableNeoHookeanSurface>({"stable-neo-hookean", "rubber sheet; stands collapse", "no SVD for forces",
                                    "after Smith, de Goes, Kim 2018, in plane stress"}),
};

}  // namespace

Catalogue membrane_materials() { return catalogue_of<kMaterials>(); }

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
