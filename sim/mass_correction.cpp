#include "sim/mass.h"

#include "sim/element_term.h"

namespace softreel::sim {
namespace {

template <int K>
struct CorrectionKernel {
  static constexpr int kCorners = K;
  static constexpr bool kConstantHessian = true;
  std::vector<double> mass;  // of each element over K (K + 1) [kg]

  double energy(int e, const Corners<K>& q) const {
    return 0.5 * mass[static_cast<size_t>(e)] * (q.rowwise().sum().squaredNorm() - K * q.squaredNorm());
  }
  void gradient(int e, const Corners<K>& q, Corners<K>& out) const {
    out = mass[static_cast<size_t>(e)] * (q.rowwise().sum().replicate(1, K) - K * q);
  }
  // Exact in any case: clamped, nothing would be left of it.
  void hessian(int e, const Corners<K>&, Definiteness, ElementHessian<K>& out) const {
    for (int a = 0; a < K; ++a)
      for (int b = 0; b < K; ++b)
        out.template block<3, 3>(3 * a, 3 * b) =
            mass[static_cast<size_t>(e)] * (a == b ? 1 - K : 1) * Eigen::Matrix3d::Identity();
  }
};

template <int K, class Elements, class Size>
std::unique_ptr<EnergyTerm> make_correction(const Elements& elements, int first_vertex, const Size& mass) {
  CorrectionKernel<K> kernel;
  std::vector<int> stencils;
  for (const auto& element : elements) {
    for (int v : element) stencils.push_back(first_vertex + v);
    kernel.mass.push_back(mass(element) / (K * (K + 1)));
  }
  return std::make_unique<ElementTerm<CorrectionKernel<K>>>("mass", EnergyKind::kElastic, std::move(stencils),
                                                            std::move(kernel));
}

}  // namespace

std::unique_ptr<EnergyTerm> make_mass_correction(const TetMesh& rest, double density, int first_vertex) {
  return make_correction<4>(rest.tets, first_vertex, [&](const Tet& t) {
    const auto vertex = [&](size_t a) { return rest.vertices[static_cast<size_t>(t[a])]; };
    return density * tet_volume(vertex(0), vertex(1), vertex(2), vertex(3));
  });
}

std::unique_ptr<EnergyTerm> make_mass_correction(const TriangleMesh& rest, double density, int first_vertex) {
  return make_correction<3>(rest.triangles, first_vertex, [&](const Triangle& t) {
    const auto vertex = [&](size_t a) { return rest.vertices[static_cast<size_t>(t[a])]; };
    return density * 0.5 * (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).norm();
  });
}

}  // namespace softreel::sim
