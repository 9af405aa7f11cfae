#include <vector>

#include "sim/contact/surface_contact.h"
#include "sim/friction_law.h"
#include "sim/parallel.h"

namespace softreel::sim {
namespace {

class SurfaceFriction final : public EnergyTerm {
 public:
  SurfaceFriction(const SurfaceContact& contact, double slip_speed) : contact_(contact), law_{slip_speed} {}

  std::string_view name() const override { return "surface friction"; }
  EnergyKind kind() const override { return EnergyKind::kDissipation; }
  bool changing_stencils() const override { return true; }
  int stencil_size() const override { return 4; }
  std::span<const int> stencils() const override { return stencils_; }

  void begin_step(const StepContext& context) override {
    touches_.clear();
    stencils_.clear();
    const ContactSurfaces& surfaces = contact_.surfaces();
    const double duration = context.t_forces - context.t;
    for (const ActivePair& pair : contact_.touching()) {
      const double friction = surfaces.pairs[static_cast<size_t>(pair.candidate.pair)].friction;
      if (friction <= 0) continue;
      Touch touch;
      touch.normal = pair.closest.r / pair.closest.distance;
      touch.limit = friction * pair.force() * parallel_share(pair.kind, pair.x, pair.penalty);
      touch.weights = pair.closest.weights;
      for (size_t i = 0; i < 4; ++i) {
        stencils_.push_back(surfaces.state_vertex[static_cast<size_t>(pair.vertices[i])]);
        if (duration > 0) touch.scripted += touch.weights[i] / duration * contact_.collider_move(pair.vertices[i]);
      }
      touches_.push_back(touch);
    }
  }

  double value(const Eigen::VectorXd& v) const override {
    return parallel_sum(count(), Work::kRow,
                        [&](int i) { return touches_[static_cast<size_t>(i)].limit * law_.value(slip(i, v).norm()); });
  }

  double power(const Eigen::VectorXd& v) const override {
    return parallel_sum(count(), Work::kRow, [&](int i) {
      const double u = slip(i, v).norm();
      return touches_[static_cast<size_t>(i)].limit * law_.over_speed(u) * u * u;
    });
  }

  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override {
    for (int i = 0; i < count(); ++i) {
      const Eigen::Vector3d u = slip(i, v);
      spread(i, touches_[static_cast<size_t>(i)].limit * law_.over_speed(u.norm()) * u, gradient);
    }
  }

  void element_hessians(const Eigen::VectorXd& v, double scale, Definiteness, StencilRange range,
                        double* blocks) const override {
    for (int i = range.first; i < range.first + range.count; ++i) {
      const Touch& touch = touches_[static_cast<size_t>(i)];
      const Eigen::Matrix3d D = scale * touch.limit * law_.hessian(touch.normal, slip(i, v), touch.stuck);
      for (size_t a = 0; a < 4; ++a)
        for (size_t b = a; b < 4; ++b, blocks += 9)
          Eigen::Map<Eigen::Matrix3d>(blocks, 3, 3) = touch.weights[a] * touch.weights[b] * D;
    }
  }

  bool harden(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) override {
    if (touches_.empty()) return false;
    const Eigen::VectorXd end = v + dv;
    bool any = false;
    for (int i = 0; i < count(); ++i) {
      Touch& touch = touches_[static_cast<size_t>(i)];
      if (touch.stuck) continue;
      const Eigen::Vector3d u = slip(i, v), du = slip(i, end) - u;
      if (law_.turned(u, du)) any = touch.stuck = true;
    }
    return any;
  }

  bool may_harden() const override { return !touches_.empty(); }

  void add_hardened_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override {
    for (int i = 0; i < count(); ++i) {
      const Touch& touch = touches_[static_cast<size_t>(i)];
      if (!touch.stuck) continue;
      const Eigen::Vector3d u = slip(i, v);
      spread(i, touch.limit * law_.excess(u.norm()) * u, gradient);
    }
  }

  void soften() override {
    for (Touch& touch : touches_) touch.stuck = false;
  }

 private:
  struct Touch {
    double limit = 0;                                    // mu times the normal force [N]
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // world
    FourNumbers weights{};                               // of the nearest points
    Eigen::Vector3d scripted = Eigen::Vector3d::Zero();  // what colliders add to the relative velocity [m/s]
    bool stuck = false;                                  // modelled by its stick branch, wherever it is
  };

  int count() const { return static_cast<int>(touches_.size()); }
  /// Sliding velocity of a touch.
  Eigen::Vector3d slip(int i, const Eigen::VectorXd& v) const {
    const Touch& touch = touches_[static_cast<size_t>(i)];
    Eigen::Vector3d relative = touch.scripted;
    for (size_t a = 0; a < 4; ++a)
      if (const int k = stencils_[4 * static_cast<size_t>(i) + a]; k >= 0)
        relative += touch.weights[a] * v.segment<3>(3 * k);
    return relative - touch.normal.dot(relative) * touch.normal;
  }
  void spread(int i, const Eigen::Vector3d& force, Eigen::VectorXd& gradient) const {
    const Touch& touch = touches_[static_cast<size_t>(i)];
    for (size_t a = 0; a < 4; ++a)
      if (const int k = stencils_[4 * static_cast<size_t>(i) + a]; k >= 0)
        gradient.segment<3>(3 * k) += touch.weights[a] * force;
  }

  const SurfaceContact& contact_;
  FrictionLaw law_;
  std::vector<Touch> touches_;
  std::vector<int> stencils_;  // four vertices of the state each
};

}  // namespace

std::unique_ptr<EnergyTerm> make_surface_friction(const SurfaceContact& contact, double slip_speed) {
  return std::make_unique<SurfaceFriction>(contact, slip_speed);
}

}  // namespace softreel::sim
