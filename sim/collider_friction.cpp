#include <cmath>
#include <numeric>
#include <vector>

#include "sim/collider_contact.h"
#include "sim/friction_law.h"
#include "sim/parallel.h"

namespace softreel::sim {
namespace {

class ColliderFriction final : public EnergyTerm {
 public:
  ColliderFriction(const ColliderContact& contact, double slip_speed)
      : contact_(contact), law_{slip_speed}, touches_of_(contact.stencils().size() + 1, 0) {}

  std::string_view name() const override { return "friction"; }
  EnergyKind kind() const override { return EnergyKind::kDissipation; }
  int stencil_size() const override { return 1; }
  std::span<const int> stencils() const override { return contact_.stencils(); }

  void begin_step(const StepContext& context) override {
    touches_.clear();
    touches_of_.assign(contact_.stencils().size() + 1, 0);
    // The normal force is the one that the last step ended with. At t = 0 there was none: an overlap that a body was
    // placed with has not pushed anything yet.
    if (context.t <= 0) return;
    const auto& colliders = contact_.colliders();
    std::vector<Eigen::Isometry3d> now, shape_now, moved;  // poses at t, their inverses, and the move to t + h
    for (const Collider& c : colliders) {
      now.push_back(c.pose(context.t));
      shape_now.push_back(now.back().inverse());
      moved.push_back(c.pose(context.t + context.h) * shape_now.back());
    }
    for (int i : contact_.stencils()) {
      const Eigen::Vector3d p = context.x.segment<3>(3 * i);
      for (size_t c = 0; c < colliders.size(); ++c) {
        if (colliders[c].friction <= 0) continue;
        const SignedDistance d = signed_distance(colliders[c].shape, shape_now[c] * p);
        const double intrusion = contact_.distance() - d.distance;
        if (intrusion <= 0) continue;
        touches_.push_back({colliders[c].friction * contact_.stiffness(i) * intrusion * intrusion,
                            now[c].linear() * d.normal, (moved[c] * p - p) / context.h});
      }
      touches_of_[static_cast<size_t>(i) + 1] = static_cast<int>(touches_.size());
    }
  }

  double value(const Eigen::VectorXd& v) const override {
    return parallel_sum(vertices(), Work::kRow, [&](int i) {
      double sum = 0;
      visit(i, [&](const Touch& touch) { sum += touch.limit * law_.value(slip(touch, v, i).norm()); });
      return sum;
    });
  }

  double power(const Eigen::VectorXd& v) const override {
    return parallel_sum(vertices(), Work::kRow, [&](int i) {
      double sum = 0;
      visit(i, [&](const Touch& touch) {
        const double u = slip(touch, v, i).norm();
        sum += touch.limit * law_.over_speed(u) * u * u;
      });
      return sum;
    });
  }

  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override {
    parallel_for(vertices(), Work::kRow, [&](int i) {
      visit(i, [&](const Touch& touch) {
        const Eigen::Vector3d u = slip(touch, v, i);
        gradient.segment<3>(3 * i) += touch.limit * law_.over_speed(u.norm()) * u;
      });
    });
  }

  void element_hessians(const Eigen::VectorXd& v, double scale, Definiteness, StencilRange range,
                        double* blocks) const override {
    for (int i = range.first; i < range.first + range.count; ++i, blocks += 9) {
      Eigen::Map<Eigen::Matrix3d> block(blocks);
      block.setZero();
      visit(i, [&](const Touch& touch) {
        block += scale * touch.limit * law_.hessian(touch.normal, slip(touch, v, i), touch.stuck);
      });
    }
  }

  bool harden(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) override {
    bool any = false;
    for (int i = 0; i < vertices(); ++i)
      for (int k = touches_of_[static_cast<size_t>(i)]; k < touches_of_[static_cast<size_t>(i) + 1]; ++k) {
        Touch& touch = touches_[static_cast<size_t>(k)];
        if (touch.stuck) continue;
        const Eigen::Vector3d u = slip(touch, v, i);
        Eigen::Vector3d du = dv.segment<3>(3 * i);
        du -= touch.normal.dot(du) * touch.normal;
        if (law_.turned(u, du)) any = touch.stuck = true;
      }
    return any;
  }

  bool may_harden() const override { return !touches_.empty(); }

  void add_hardened_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override {
    parallel_for(vertices(), Work::kRow, [&](int i) {
      visit(i, [&](const Touch& touch) {
        if (!touch.stuck) return;
        const Eigen::Vector3d u = slip(touch, v, i);
        gradient.segment<3>(3 * i) += touch.limit * law_.excess(u.norm()) * u;
      });
    });
  }

  void soften() override {
    for (Touch& touch : touches_) touch.stuck = false;
  }

 private:
  struct Touch {
    double limit;              // mu times the normal force [N]
    Eigen::Vector3d normal;    // world
    Eigen::Vector3d velocity;  // of the collider at the point [m/s]
    bool stuck = false;        // modelled by its stick branch, wherever it is
  };

  int vertices() const { return static_cast<int>(touches_of_.size()) - 1; }
  template <class Visit>
  void visit(int i, const Visit& each) const {
    for (int k = touches_of_[static_cast<size_t>(i)]; k < touches_of_[static_cast<size_t>(i) + 1]; ++k)
      each(touches_[static_cast<size_t>(k)]);
  }
  static Eigen::Vector3d slip(const Touch& touch, const Eigen::VectorXd& v, int i) {
    const Eigen::Vector3d relative = v.segment<3>(3 * i) - touch.velocity;
    return relative - touch.normal.dot(relative) * touch.normal;
  }

  const ColliderContact& contact_;
  FrictionLaw law_;
  std::vector<Touch> touches_;   // by vertex, then collider
  std::vector<int> touches_of_;  // vertices + 1 offsets
};

}  // namespace

std::unique_ptr<EnergyTerm> make_collider_friction(const ColliderContact& contact, double slip_speed) {
  return std::make_unique<ColliderFriction>(contact, slip_speed);
}

}  // namespace softreel::sim
