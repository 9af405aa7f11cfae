#include "sim/drag.h"

#include <numeric>

#include "sim/element_term.h"

namespace softreel::sim {
namespace {

struct DragKernel {
  static constexpr int kCorners = 1;
  static constexpr bool kConstantHessian = true;
  Eigen::VectorXd coefficient;  // mass times rate [kg/s]

  double energy(int e, const Corners<1>& v) const { return 0.5 * coefficient(e) * v.squaredNorm(); }
  void gradient(int e, const Corners<1>& v, Corners<1>& out) const { out = coefficient(e) * v; }
  void hessian(int e, const Corners<1>&, Definiteness, ElementHessian<1>& out) const {
    out = coefficient(e) * Eigen::Matrix3d::Identity();
  }
};

}  // namespace

std::unique_ptr<EnergyTerm> make_drag(const Eigen::VectorXd& masses, double rate) {
  std::vector<int> vertices(static_cast<size_t>(masses.size()));
  std::iota(vertices.begin(), vertices.end(), 0);
  return std::make_unique<ElementTerm<DragKernel>>("drag", EnergyKind::kDissipation, std::move(vertices),
                                                   DragKernel{rate * masses});
}

}  // namespace softreel::sim
