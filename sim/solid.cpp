#include "sim/solid.h"

#include <Eigen/LU>
#include <array>
#include <stdexcept>
#include <string>

#include "sim/element_term.h"
#include "sim/materials/corotated_volume.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/method_table.h"

namespace softreel::sim {
namespace {

template <class Material>
struct SolidKernel {
  static constexpr int kCorners = 4;
  static constexpr bool kConstantHessian = false;

  Material material;
  struct Rest {
    Eigen::Matrix3d gradient;  // Dm^-1; row a - 1: grad N_a of corner a = 1, 2, 3 [1/m]
    double volume;             // [m^3]
  };
  std::vector<Rest> rest;

  double energy(int e, const Corners<4>& X) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    return r.volume * material.psi(deformation(X, r));
  }

  void gradient(int e, const Corners<4>& X, Corners<4>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const Eigen::Matrix3d P = material.pk1(deformation(X, r));
    out.rightCols<3>().noalias() = r.volume * P * r.gradient.transpose();
    out.col(0) = -(out.col(1) + out.col(2) + out.col(3));
  }

  // K_ab = w sum_jl (grad N_a)_j (grad N_b)_l d2psi/dF_:j dF_:l. In the principal frame d2psi/dF2 is nearly diagonal,
  // so the sum is taken there: b_a = V^T grad N_a, K_ab = w U (..) U^T.
  void hessian(int e, const Corners<4>& X, Definiteness definiteness, ElementHessian<4>& out) const {
    const Rest& r = rest[static_cast<size_t>(e)];
    const Principal3 p = principal_stretches(deformation(X, r));
    PrincipalHessian3 h = material.hessian(p.sigma);
    if (definiteness == Definiteness::kClamped) clamp(h);
    const Eigen::Matrix3d b = p.V.transpose() * r.gradient.transpose();  // column a - 1
    Eigen::Matrix3d same, swapped;                                       // coefficients of (rj, rj) and of (rs, sr)
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      same(i, j) = same(j, i) = 0.5 * (h.symmetric(k) + h.antisymmetric(k));
      swapped(i, j) = swapped(j, i) = 0.5 * (h.symmetric(k) - h.antisymmetric(k));
      same(k, k) = h.stretch(k, k);
    }
    for (int a = 0; a < 3; ++a) {
      for (int c = a; c < 3; ++c) {
        Eigen::Matrix3d N;
        for (int row = 0; row < 3; ++row) {
          N(row, row) =
              same(row, 0) * b(0, a) * b(0, c) + same(row, 1) * b(1, a) * b(1, c) + same(row, 2) * b(2, a) * b(2, c);
          for (int col = 0; col < 3; ++col)
            if (col != row)
              N(row, col) = h.stretch(row, col) * b(row, a) * b(col, c) + swapped(row, col) * b(col, a) * b(row, c);
        }
        const Eigen::Matrix3d K = r.volume * p.U * N * p.U.transpose();
        out.block<3, 3>(3 * (a + 1), 3 * (c + 1)) = K;
        if (a != c) out.block<3, 3>(3 * (c + 1), 3 * (a + 1)) = K.transpose();
      }
    }
    // A translation costs nothing: the rows of corner 0 are minus the sum of the others.
    for (int a = 1; a < 4; ++a)
      out.block<3, 3>(0, 3 * a) = -(out.block<3, 3>(3, 3 * a) + out.block<3, 3>(6, 3 * a) + out.block<3, 3>(9, 3 * a));
    for (int a = 1; a < 4; ++a) out.block<3, 3>(3 * a, 0) = out.block<3, 3>(0, 3 * a).transpose();
    out.block<3, 3>(0, 0) = -(out.block<3, 3>(0, 3) + out.block<3, 3>(0, 6) + out.block<3, 3>(0, 9));
  }

 private:
  static Eigen::Matrix3d deformation(const Corners<4>& X, const Rest& r) {
    Eigen::Matrix3d Ds;  // from corner 0, so that large coordinates do not cost digits
    Ds << X.col(1) - X.col(0), X.col(2) - X.col(0), X.col(3) - X.col(0);
    return Ds * r.gradient;
  }
};

template <class Material>
std::unique_ptr<EnergyTerm> make(std::string_view name, const Material& material, const TetMesh& mesh,
                                 int first_vertex) {
  SolidKernel<Material> kernel{material, {}};
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
  return std::make_unique<ElementTerm<SolidKernel<Material>>>(name, EnergyKind::kElastic, std::move(stencils),
                                                              std::move(kernel));
}

struct Entry {
  MethodInfo info;
  std::unique_ptr<EnergyTerm> (*make)(const Lame&, const TetMesh&, int);
};

template <class Material>
constexpr Entry entry(const MethodInfo& info) {
  return {info,
          [](const Lame& lame, const TetMesh& mesh, int first) { return make("solid", Material(lame), mesh, first); }};
}

// The one table of solid materials: a new one is its header and an entry here.
constexpr std::array kMaterials = {
    entry<StableNeoHookean>({"stable-neo-hookean", "rubber and flesh; stands inversion", "no SVD for forces",
                             "Smith, de Goes, Kim 2018, section 3.4"}),
    entry<CorotatedVolume>({"corotated-volume", "linear elasticity in the rotated frame, volume by its trace",
                            "SVD per tetrahedron", "Sifakis, Barbic 2012, section 3.4"}),
};

}  // namespace

Catalogue solid_materials() { return catalogue_of<kMaterials>(); }

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
