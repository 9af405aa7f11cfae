#pragma once
// The element loop, written once: gather the corners, call the kernel, write an own slot, add up in index order.
#include <Eigen/Core>
#include <vector>

#include "sim/energy_term.h"
#include "sim/parallel.h"

namespace softreel::sim {

template <int K>
using Corners = Eigen::Matrix<double, 3, K>;
template <int K>
using ElementHessian = Eigen::Matrix<double, 3 * K, 3 * K>;

/// For each vertex that any stencil touches, the slots (stencil * k + corner) that belong to it, in index order.
class VertexSlots {
 public:
  explicit VertexSlots(std::span<const int> stencils);

  /// target.segment<3>(3 vertex) += sum of the vertex' slots (3 doubles each).
  void add(const std::vector<double>& slots, Eigen::VectorXd& target) const;

 private:
  std::vector<int> vertices_;
  std::vector<int> first_;  // vertices_.size() + 1 offsets into slots_
  std::vector<int> slots_;
};

/// A sum over elements. Kernel has
///   static constexpr int kCorners, constexpr bool kConstantHessian;
///   double energy(int e, const Corners<K>&) const;
///   void gradient(int e, const Corners<K>&, Corners<K>& out) const;
///   void hessian(int e, const Corners<K>&, Definiteness, ElementHessian<K>& out) const;  // at least its upper blocks
template <class Kernel>
class ElementTerm final : public EnergyTerm {
 public:
  static constexpr int K = Kernel::kCorners;

  /// `stencils`: K vertex indices per element of `kernel`.
  ElementTerm(std::string_view name, EnergyKind kind, std::vector<int> stencils, Kernel kernel)
      : name_(name),
        kind_(kind),
        stencils_(std::move(stencils)),
        kernel_(std::move(kernel)),
        vertex_slots_(stencils_),
        gradient_slots_(stencils_.size() * 3) {}

  std::string_view name() const override { return name_; }
  EnergyKind kind() const override { return kind_; }
  int elements() const { return static_cast<int>(stencils_.size()) / K; }
  Kernel& kernel() { return kernel_; }

  void begin_step(const StepContext& context) override {
    if constexpr (requires { kernel_.begin_step(context, std::span<const int>{}); })
      kernel_.begin_step(context, stencils_);
  }

  double value(const Eigen::VectorXd& q) const override {
    return parallel_sum(elements(), Work::kRow, [&](int e) { return kernel_.energy(e, gather(q, e)); });
  }

  void add_gradient(const Eigen::VectorXd& q, Eigen::VectorXd& gradient) const override {
    parallel_for(elements(), Work::kRow, [&](int e) {
      Corners<K> g;
      kernel_.gradient(e, gather(q, e), g);
      Eigen::Map<Corners<K>>(gradient_slots_.data() + static_cast<size_t>(e) * 3 * K) = g;
    });
    vertex_slots_.add(gradient_slots_, gradient);
  }

  int stencil_size() const override { return K; }
  std::span<const int> stencils() const override { return stencils_; }
  bool constant_hessian() const override { return Kernel::kConstantHessian; }

  void element_hessians(const Eigen::VectorXd& q, double scale, Definiteness definiteness, StencilRange range,
                        double* blocks) const override {
    for (int e = range.first; e < range.first + range.count; ++e) {
      ElementHessian<K> hessian;
      kernel_.hessian(e, gather(q, e), definiteness, hessian);
      for (int a = 0; a < K; ++a)
        for (int b = a; b < K; ++b, blocks += 9)
          Eigen::Map<Eigen::Matrix3d>{blocks} = scale * hessian.template block<3, 3>(3 * a, 3 * b);
    }
  }

 private:
  Corners<K> gather(const Eigen::VectorXd& q, int e) const {
    Corners<K> corners;
    for (int a = 0; a < K; ++a)
      corners.col(a) = q.segment<3>(3 * stencils_[static_cast<size_t>(e) * K + static_cast<size_t>(a)]);
    return corners;
  }

  std::string_view name_;
  EnergyKind kind_;
  std::vector<int> stencils_;
  Kernel kernel_;
  VertexSlots vertex_slots_;
  mutable std::vector<double> gradient_slots_;  // scratch; kept so that a step allocates nothing
};

/// Sets the negative eigenvalues of a symmetric matrix to zero; leaves it alone, to the bit, if there are none.
template <int N>
void clamp_to_semidefinite(Eigen::Matrix<double, N, N>& symmetric);

extern template void clamp_to_semidefinite<2>(Eigen::Matrix2d&);
extern template void clamp_to_semidefinite<3>(Eigen::Matrix3d&);
extern template void clamp_to_semidefinite<12>(Eigen::Matrix<double, 12, 12>&);

}  // namespace softreel::sim
