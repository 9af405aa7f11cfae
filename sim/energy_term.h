#pragma once
// What a scene is made of: a list of energies behind one small interface.
#include <Eigen/Core>
#include <span>
#include <string_view>

namespace softreel::sim {

/// For the bookkeeping of energies; dead loads count with gravity.
enum class EnergyKind { kElastic, kGravity, kContact, kDissipation };

/// Which Hessian an element gives.
enum class Definiteness {
  kExact,
  kClamped,  ///< negative eigenvalues of the element's Hessian set to zero; exact where there are none
};

inline constexpr int kMostVertices = 4;  ///< of a stencil

/// Stencils [first, first + count) of a term.
struct StencilRange {
  int first = 0, count = 0;
};

/// The step that is about to be solved; lagged quantities are taken from it.
struct StepContext {
  const Eigen::VectorXd& x;            ///< positions at t, 3n [m]
  const Eigen::VectorXd& v;            ///< velocities at t, 3n [m/s]
  const Eigen::VectorXd& x_predicted;  ///< where forces are taken, as far as x and v tell, 3n [m]
  double t = 0;                        ///< start of the step [s]
  double h = 0;                        ///< its length [s]
  double h_nominal = 0;                ///< the step that was asked for; longer than h while it is taken in halves [s]
  double t_forces = 0;                 ///< when forces are taken: t + h, or in between [s]
  double load_factor = 1;              ///< how much of gravity and loads there is; below 1 on the way to an equilibrium
};

/// A scalar function of a stacked vector q (3n): a potential E(x) [J] of the positions, or a dissipation potential
/// D(v) [W] of the velocities. Virtual once per term, never per element.
///
/// Its Hessian is a sum over small stencils of vertices. The stencils stay what they are for the life of the term, but
/// for terms that say otherwise (contact between surfaces).
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;

  virtual std::string_view name() const = 0;
  virtual EnergyKind kind() const = 0;

  /// Takes lagged quantities from the start of a step; called before each step is solved, and before explicit methods
  /// ask for forces.
  virtual void begin_step(const StepContext&) {}

  virtual double value(const Eigen::VectorXd& q) const = 0;

  /// gradient += d value / dq; both 3n.
  virtual void add_gradient(const Eigen::VectorXd& q, Eigen::VectorXd& gradient) const = 0;

  /// What a dissipation potential takes out of the motion at velocities v, 3n [W].
  virtual double power(const Eigen::VectorXd& v) const {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
    add_gradient(v, force);
    return force.dot(v);
  }

  /// Vertices per stencil k (1 to kMostVertices); 0 for a term without a Hessian (a linear function).
  virtual int stencil_size() const { return 0; }
  /// Vertex indices, k per stencil; -1 (with changing stencils only): not a vertex of the state, nothing is added
  /// there.
  virtual std::span<const int> stencils() const { return {}; }
  /// True if the stencils depend on the positions; `select` then makes them those of q.
  virtual bool changing_stencils() const { return false; }
  virtual void select(const Eigen::VectorXd& q) const { static_cast<void>(q); }
  /// True if the element Hessians never change: they are computed once.
  virtual bool constant_hessian() const { return false; }

  /// Writes scale * element Hessian of the stencils in `range`: the upper 3x3 blocks (a, b), a <= b, of each, row by
  /// row, column-major: 9 k (k + 1) / 2 doubles per stencil. Several threads may ask for different ranges at once.
  virtual void element_hessians(const Eigen::VectorXd& q, double scale, Definiteness definiteness, StencilRange range,
                                double* blocks) const {
    static_cast<void>(q), static_cast<void>(scale), static_cast<void>(definiteness), static_cast<void>(range),
        static_cast<void>(blocks);
  }

  /// A solver proposes to go from q to q + dq. A term whose derivative turns sharply on the way (friction) may answer
  /// true: from now on, until `soften`, its Hessians are those of another branch, which suits the end of that step
  /// better, and the step should be proposed anew.
  virtual bool harden(const Eigen::VectorXd& q, const Eigen::VectorXd& dq) {
    static_cast<void>(q), static_cast<void>(dq);
    return false;
  }
  /// False if `harden` is sure to answer so in this step.
  virtual bool may_harden() const { return false; }
  /// gradient += what that branch's gradient at q has over the true one.
  virtual void add_hardened_gradient(const Eigen::VectorXd& q, Eigen::VectorXd& gradient) const {
    static_cast<void>(q), static_cast<void>(gradient);
  }
  virtual void soften() {}
};

/// Doubles that one stencil of k vertices writes in element_hessians.
constexpr int hessian_doubles(int k) { return 9 * k * (k + 1) / 2; }

inline int stencil_count(const EnergyTerm& term) {
  return term.stencil_size() > 0 ? static_cast<int>(term.stencils().size()) / term.stencil_size() : 0;
}

/// Element Hessians of all stencils, one after the other; in parallel.
void all_element_hessians(const EnergyTerm& term, const Eigen::VectorXd& q, double scale, Definiteness definiteness,
                          double* blocks);

}  // namespace softreel::sim
