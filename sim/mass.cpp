#include "sim/mass.h"

#include <stdexcept>

#include "sim/element_term.h"
#include "sim/hessian_assembler.h"
#include "sim/parallel.h"

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

MassMatrix::MassMatrix(const Model& model, const std::vector<std::uint8_t>& held) : model_(model), held_(held) {}

double MassMatrix::energy(const Eigen::VectorXd& q) const {
  double sum = 0.5 * parallel_sum(model_.vertices(), Work::kVector,
                                  [&](int i) { return model_.masses(i) * q.segment<3>(3 * i).squaredNorm(); });
  for (const auto& term : model_.mass_corrections) sum += term->value(q);
  return sum;
}

void MassMatrix::add_product(const Eigen::VectorXd& q, Eigen::VectorXd& out) const {
  parallel_for(model_.vertices(), Work::kVector,
               [&](int i) { out.segment<3>(3 * i) += model_.masses(i) * q.segment<3>(3 * i); });
  for (const auto& term : model_.mass_corrections) term->add_gradient(q, out);
}

void MassMatrix::solve(Eigen::VectorXd& f) {
  parallel_for(static_cast<int>(f.size()), Work::kVector, [&](int i) {
    if (held_[static_cast<size_t>(i)]) f(i) = 0;
  });
  if (model_.mass_corrections.empty()) {
    parallel_for(model_.vertices(), Work::kVector, [&](int i) { f.segment<3>(3 * i) /= model_.masses(i); });
    return;
  }
  if (!solver_) {
    std::vector<const EnergyTerm*> terms;
    std::vector<ScaledTerm> scaled;
    for (const auto& t : model_.mass_corrections) {
      terms.push_back(t.get());
      scaled.push_back({t.get(), &model_.x0, 1.0});
    }
    HessianAssembler(model_.vertices(), terms).assemble(scaled, model_.masses, held_, Definiteness::kExact, M_);
    solver_ = make_linear_solver("cholesky");
    solver_->analyse(M_);
    solver_->factorize(M_);
  }
  scratch_ = f;
  const LinearReport report = solver_->solve(scratch_, {}, f);
  if (!report.ok) throw std::logic_error("the mass matrix cannot be factorized: " + report.reason);
}

}  // namespace softreel::sim
