#include "sim/stiffness_damping.h"

#include <vector>

#include "sim/element_term.h"

namespace softreel::sim {
namespace {

class StiffnessDamping final : public EnergyTerm {
 public:
  StiffnessDamping(const EnergyTerm& elastic, double beta)
      : elastic_(elastic),
        beta_(beta),
        k_(elastic.stencil_size()),
        elements_(stencil_count(elastic)),
        blocks_(static_cast<size_t>(elements_) * static_cast<size_t>(hessian_doubles(k_))),
        gradient_slots_(elastic.stencils().size() * 3),
        vertex_slots_(elastic.stencils()) {}

  std::string_view name() const override { return "stiffness damping"; }
  EnergyKind kind() const override { return EnergyKind::kDissipation; }
  int stencil_size() const override { return k_; }
  std::span<const int> stencils() const override { return elastic_.stencils(); }

  void begin_step(const StepContext& context) override {
    all_element_hessians(elastic_, context.x_predicted, beta_, Definiteness::kClamped, blocks_.data());
  }

  double value(const Eigen::VectorXd& v) const override {
    return 0.5 * parallel_sum(elements_, Work::kRow, [&](int e) {
             double sum = 0;
             for (int a = 0; a < k_; ++a) sum += velocity(v, e, a).dot(force(v, e, a));
             return sum;
           });
  }

  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override {
    parallel_for(elements_, Work::kRow, [&](int e) {
      for (int a = 0; a < k_; ++a)
        Eigen::Map<Eigen::Vector3d>(gradient_slots_.data() + 3 * static_cast<size_t>(e * k_ + a)) = force(v, e, a);
    });
    vertex_slots_.add(gradient_slots_, gradient);
  }

  void element_hessians(const Eigen::VectorXd&, double scale, Definiteness, StencilRange range,
                        double* blocks) const override {
    const auto doubles = static_cast<size_t>(hessian_doubles(k_));
    const double* own = blocks_.data() + doubles * static_cast<size_t>(range.first);
    for (size_t i = 0; i < doubles * static_cast<size_t>(range.count); ++i) blocks[i] = scale * own[i];
  }

 private:
  Eigen::Vector3d velocity(const Eigen::VectorXd& v, int e, int corner) const {
    return v.segment<3>(3 * elastic_.stencils()[static_cast<size_t>(e * k_ + corner)]);
  }
  /// Row `a` of beta K_e v_e.
  Eigen::Vector3d force(const Eigen::VectorXd& v, int e, int a) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int b = 0; b < k_; ++b) {
      const int low = std::min(a, b), high = std::max(a, b);
      const int block = low * k_ - low * (low - 1) / 2 + (high - low);
      const Eigen::Map<const Eigen::Matrix3d> K(blocks_.data() +
                                                static_cast<size_t>(e) * static_cast<size_t>(hessian_doubles(k_)) +
                                                9 * static_cast<size_t>(block));
      if (a <= b)
        sum += K * velocity(v, e, b);
      else
        sum += K.transpose() * velocity(v, e, b);
    }
    return sum;
  }

  const EnergyTerm& elastic_;
  double beta_;
  int k_, elements_;
  std::vector<double> blocks_;
  mutable std::vector<double> gradient_slots_;
  VertexSlots vertex_slots_;
};

}  // namespace

std::unique_ptr<EnergyTerm> make_stiffness_damping(const EnergyTerm& elastic, double beta) {
  return std::make_unique<StiffnessDamping>(elastic, beta);
}

}  // namespace softreel::sim
