#pragma once
// The small motions of a model about its start, M u'' + C u' + K u = 0, and the fastest of them.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/block_matrix.h"
#include "sim/mass.h"
#include "sim/model.h"

namespace softreel::sim {

/// One motion u = shape exp(i omega t), damped: u'' + 2 xi omega u' + omega^2 u = 0.
struct Mode {
  double omega = 0;          ///< [rad/s]; never above the true one, but by rounding
  double omega_bound = 0;    ///< omega, and what the iteration may still have missed [rad/s]
  double damping_ratio = 0;  ///< xi [-]
  Eigen::VectorXd shape;     ///< 3n, |shape|_M = 1
};

/// Whether vertices are free, or each lies on the surface of the collider that is nearest to it at the start: it then
/// intrudes by d_hat, so its penalty adds psi'' = 2 k d_hat along that collider's normal.
enum class Touch { kNone, kAll };

/// K is the exact Hessian of the potentials at the start, C that of the dissipation potentials, M the mass matrix, all
/// without what pins hold. The stiffness of a penalty may depend on the step, so the step is part of this.
class Linearization {
 public:
  /// Takes lagged quantities at the start, as a step of length h [s] would. `stretch`: K where all coordinates are
  /// multiplied by it, so that every element is stretched so much. `model` must outlive this; its terms begin a step.
  Linearization(const Model& model, double h, double stretch = 1);
  Linearization(const Linearization&) = delete;
  Linearization& operator=(const Linearization&) = delete;

  /// The penalties of another step, h [s] > 0.
  void set_step(double h);

  /// The modes that limit an explicit step: that of the largest omega, and, if anything is damped, that of the largest
  /// eigenvalue of K + 2 C/h, which the symplectic Euler method loses first (with z = -1 its step from (x, v) asks for
  /// (h^2 K + 2 h C) x = 4 M x). `body`: of that one alone, the others held; null: of all.
  std::vector<Mode> fastest(Touch touch, const BodyRange* body = nullptr);

  /// Whether any vertex could touch anything.
  bool has_contact() const { return model_.contact != nullptr; }

  /// Products with K so far.
  int products() const { return products_; }

 private:
  void multiply(const Eigen::VectorXd& q, double damping, bool touch, Eigen::VectorXd& out) const;
  Mode find(double damping, bool touch, const BodyRange* body);

  const Model& model_;
  double h_;
  Pins pins_;
  MassMatrix mass_;
  BlockMatrix K_, C_;
  Eigen::VectorXd contact_;  // psi'' of each vertex, n [N/m]
  Eigen::Matrix3Xd normals_;
  mutable Eigen::VectorXd scratch_;
  int products_ = 0;
};

/// The body that moves most in a mode, and where: the index in model.bodies of the largest part of the kinetic energy,
/// and the vertex in it that moves fastest.
struct ModePlace {
  int body = 0;
  int vertex = 0;
};
ModePlace place_of(const Model& model, const Mode& mode);

}  // namespace softreel::sim
