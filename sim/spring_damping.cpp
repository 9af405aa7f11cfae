#include "sim/spring_damping.h"

#include "sim/spring_stencil.h"

namespace softreel::sim {
namespace {

struct SpringDampingKernel {
  static constexpr int kCorners = 2;
  static constexpr bool kConstantHessian = false;
  double damping;  // [N s/m]
  std::vector<Eigen::Vector3d> direction;

  void begin_step(const StepContext& context, std::span<const int> stencils) {
    for (size_t e = 0; e < direction.size(); ++e) {
      const Eigen::Vector3d d =
          context.x_predicted.segment<3>(3 * stencils[2 * e]) - context.x_predicted.segment<3>(3 * stencils[2 * e + 1]);
      const double length = d.norm();
      direction[e] = length > 0 ? Eigen::Vector3d(d / length) : Eigen::Vector3d::Zero();
    }
  }

  double energy(int e, const Corners<2>& V) const {
    const double rate = direction[static_cast<size_t>(e)].dot(V.col(0) - V.col(1));
    return 0.5 * damping * rate * rate;
  }
  void gradient(int e, const Corners<2>& V, Corners<2>& out) const {
    const Eigen::Vector3d& d = direction[static_cast<size_t>(e)];
    out.col(0) = damping * d.dot(V.col(0) - V.col(1)) * d;
    out.col(1) = -out.col(0);
  }
  void hessian(int e, const Corners<2>&, Definiteness, ElementHessian<2>& out) const {
    const Eigen::Vector3d& d = direction[static_cast<size_t>(e)];
    spring_block(damping * d * d.transpose(), out);
  }
};

}  // namespace

std::unique_ptr<EnergyTerm> make_spring_damping(const std::vector<Spring>& springs, double damping) {
  SpringDampingKernel kernel{damping, std::vector<Eigen::Vector3d>(springs.size(), Eigen::Vector3d::Zero())};
  return std::make_unique<ElementTerm<SpringDampingKernel>>("spring damping", EnergyKind::kDissipation,
                                                            spring_stencils(springs), std::move(kernel));
}

}  // namespace softreel::sim
