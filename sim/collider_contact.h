#pragma once
// Penalty contact and Coulomb friction of vertices with rigid colliders.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/collider.h"
#include "sim/collider_core.h"
#include "sim/energy_term.h"

namespace softreel::sim {

struct ContactSettings {
  double distance = 2e-3;    ///< d_hat: the penalty begins here [m] > 0
  double slip_speed = 1e-3;  ///< friction holds below [m/s] > 0
  double stiffness = 0;      ///< k [N/m^2] for every vertex; 0: from mass and step
  double hardness = 100;     ///< c in k = c m/(h^2 d_hat), where k comes from mass and step; see kExplicitHardness
  double material = 1;       ///< between surfaces: k is more by this times the stiffness of the material / d_hat
};

/// What the contact did in a step.
struct ContactReport {
  int active = 0;       ///< vertices within d_hat
  double smallest = 0;  ///< smallest signed distance [m]; meaningful if active > 0
};

/// psi(d) = k/3 (d_hat - d)^3 for d < d_hat; goes on inside the collider, so what a step threw inside is pushed out.
///
/// An explicit method with the step h is stable up to h^2 psi''/m = 2 c s/d_hat < 4 at the intrusion s = d_hat - d:
/// with c = 1/2 as far as an intrusion of 4 d_hat.
inline constexpr double kExplicitHardness = 0.5;

/// Without a given stiffness, k = 100 m/(h^2 d_hat), h the nominal step (halves keep it, so energy stays what it was):
/// at the surface a vertex is stopped from a speed of 100 d_hat per step, or carries a column of (100 d_hat/h^2)/g
/// vertices like itself.
class ColliderContact : public EnergyTerm {
 public:
  /// `masses` [kg] per vertex of the state.
  ColliderContact(const Eigen::VectorXd& masses, std::vector<Collider> colliders, const ContactSettings& settings);

  std::string_view name() const override { return "contact"; }
  EnergyKind kind() const override { return EnergyKind::kContact; }
  void begin_step(const StepContext& context) override;
  double value(const Eigen::VectorXd& x) const override;
  void add_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const override;
  int stencil_size() const override { return 1; }
  std::span<const int> stencils() const override { return vertices_; }
  void element_hessians(const Eigen::VectorXd& x, double scale, Definiteness, StencilRange range,
                        double* blocks) const override;

  /// Is there a collider that could be passed through? If not, the three below have nothing to look at.
  bool has_cores() const { return !cores_.empty(); }
  /// The share, in [0, 1], of the move dx on which no vertex passes through a collider (collider_core.h), colliders
  /// being where they are when forces are taken. Left out: vertices of which a coordinate is held (3n flags), which go
  /// where a script takes them.
  double max_step(const Eigen::VectorXd& x, const Eigen::VectorXd& dx, std::span<const std::uint8_t> held) const;
  /// Does the straight way between two states pass through none, as seen from each collider on its own way? Else
  /// `blocking` tells.
  bool way_is_free(const Eigen::VectorXd& from, double t_from, const Eigen::VectorXd& to, double t_to,
                   std::span<const std::uint8_t> held) const;
  /// The vertex that was stopped last; -1: none was.
  int blocking() const { return blocking_; }

  const std::vector<Collider>& colliders() const { return colliders_; }
  double distance() const { return settings_.distance; }
  double stiffness(int vertex) const { return stiffness_(vertex); }
  /// Distance and world normal of a point from collider c at time t.
  SignedDistance at(int collider, double t, const Eigen::Vector3d& point) const;
  ContactReport report(const Eigen::VectorXd& x) const;

 private:
  struct Posed {
    Eigen::Isometry3d world_from_shape, shape_from_world;
  };
  void place(double t);
  template <class Visit>
  void visit(const Eigen::Vector3d& point, const Visit& each) const;
  template <class Way>
  double shortest(const Way& way, std::span<const std::uint8_t> held) const;

  Eigen::VectorXd masses_;
  std::vector<Collider> colliders_;
  ContactSettings settings_;
  std::vector<int> vertices_;
  Eigen::VectorXd stiffness_;  // [N/m^2]
  std::vector<Posed> posed_;   // when forces are taken
  struct NumberedCore {
    size_t collider;
    ColliderCore core;
  };
  std::vector<NumberedCore> cores_;
  mutable int blocking_ = -1;
};

/// Smoothed Coulomb friction as a dissipation potential, D(v) = sum mu lambda f(|T (v - v_collider)|) (Li et al. 2020,
/// IPC, section 5): f' rises to 1 at slip_speed. Normal forces lambda and tangent planes T are lagged: those of the
/// positions at the start of the step. `contact` must outlive the term, and begin its steps first.
std::unique_ptr<EnergyTerm> make_collider_friction(const ColliderContact& contact, double slip_speed);

}  // namespace softreel::sim
