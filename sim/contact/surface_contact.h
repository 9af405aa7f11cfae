#pragma once
// Penalty contact between surfaces, which no accepted move jumps over.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/contact/contact_candidates.h"
#include "sim/contact/contact_surfaces.h"
#include "sim/contact/pair_energy.h"
#include "sim/energy_term.h"

namespace softreel::sim {

/// c between surfaces, if the scene asks for no less: softer than against colliders, since no step can jump over it,
/// and a pair that comes too near hardens on its own. Measured on draped cloth: half of the Newton iterations that 100
/// takes.
inline constexpr double kSurfaceHardness = 30;

struct SurfaceContactSettings {
  double distance = 2e-3;              ///< d_hat: the penalty begins here [m] > 0
  double stiffness = 0;                ///< k [N/m^2] of every pair; 0: from mass, step and material
  double hardness = kSurfaceHardness;  ///< c in k = (c m/h^2 + s K)/d_hat, where k comes from mass, step and material
  double material = 1;  ///< s, of the stiffness K around a vertex: so a pair gives about as much as its material
};

/// A pair of features within reach, with all that its energy needs.
struct ActivePair {
  PairKind kind = PairKind::kPointTriangle;
  Candidate candidate;
  std::array<int, 4> vertices{};  ///< of the contact surfaces
  FourPoints x{};                 ///< [m]
  ClosestPoints closest;
  PairPenalty penalty;

  double gap() const { return closest.distance - penalty.offset; }                     ///< [m]
  double force() const { return penalty.force(penalty.intrusion(closest.distance)); }  ///< [N]
};

/// What contact of surfaces was at some positions.
struct SurfaceContactReport {
  long searches = 0;  ///< of the broad phase, since the start
  long candidates = 0;
  long active = 0;          ///< pairs within reach
  double smallest_gap = 0;  ///< [m]; meaningful if active > 0
  double deepest = 0;       ///< deepest intrusion into the contact distance, as a share of it
};

/// Touches that hold, and that slide.
struct SlidingCount {
  long sticks = 0, slips = 0;
};

/// E = sum of psi over all pairs of features within d_hat. Its stencils change with the positions: `select`.
///
/// The stiffness of a pair is that of the lighter side, k = (30 m/h^2 + K)/d_hat, K the stiffness of the material
/// around; it is frozen within a solve. Where that does not hold (continuous collision detection blocks a solve, or it
/// ends with a gap below 0.1 d_hat), `stiffen` quadruples it at the vertices concerned, and the step is solved again;
/// vertices that have come free soften step by step.
class SurfaceContact final : public EnergyTerm {
 public:
  /// `masses`, `stiffness` (stiffness_scale): of the state's vertices, n [kg], [N/m].
  SurfaceContact(std::unique_ptr<const ContactSurfaces> surfaces, const Eigen::VectorXd& masses,
                 const Eigen::VectorXd& stiffness, const SurfaceContactSettings& settings);

  std::string_view name() const override { return "surface contact"; }
  EnergyKind kind() const override { return EnergyKind::kContact; }
  void begin_step(const StepContext& context) override;
  double value(const Eigen::VectorXd& x) const override;
  void add_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const override;
  bool changing_stencils() const override { return true; }
  void select(const Eigen::VectorXd& x) const override;
  int stencil_size() const override { return 4; }
  std::span<const int> stencils() const override { return stencils_; }
  void element_hessians(const Eigen::VectorXd& x, double scale, Definiteness definiteness, StencilRange range,
                        double* blocks) const override;
  /// The share, in [0, 1], of the move dx on which nothing passes through: no gap falls below a tenth of what it is at
  /// x.
  double max_step(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const;

  const ContactSurfaces& surfaces() const { return *surfaces_; }
  const SurfaceContactSettings& settings() const { return settings_; }

  /// Scripted colliders go from where they are at the start of the step to where they belong at its forces' time, by
  /// this share in [0, 1]; begin_step sets 1.
  void set_progress(double progress);
  double progress() const { return progress_; }
  /// Do any move in this step?
  bool colliders_move() const { return colliders_move_; }
  /// force += change of the gradient (held vertices left out by the caller) when colliders go the rest of their way.
  void add_driven_force(const Eigen::VectorXd& x, Eigen::VectorXd& force);

  /// From now on, surfaces of which every vertex is held (3n flags; empty: none is) do not touch each other, nor
  /// colliders without a motion.
  void leave_out(std::span<const std::uint8_t> held);

  /// Pairs within reach at x.
  const std::vector<ActivePair>& active(const Eigen::VectorXd& x) const;
  /// Those at the start of the step.
  const std::vector<ActivePair>& touching() const { return touching_; }
  /// What may come within reach in the step.
  const ContactCandidates& candidates() const { return candidates_; }
  /// Displacement of a collider's vertex in the step [m]; zero for others.
  Vec3 collider_move(int vertex) const;

  /// True if the straight way between two states, colliders moving with it, jumps over nothing; else names are set.
  bool way_is_free(const Eigen::VectorXd& from, double t_from, const Eigen::VectorXd& to, double t_to) const;

  /// Quadruples the stiffness where `x` has a gap below 0.1 d_hat. False if there is none, or all are at their bound.
  bool stiffen_near(const Eigen::VectorXd& x);
  /// The same for the pair that cut the last move short.
  bool stiffen_blocking();
  /// Is one of them at its bound?
  bool at_bound() const { return at_bound_; }
  /// "'a' and 'b'": what blocked last.
  std::string blocking() const;
  /// Energy that stiffening has added since the start [J].
  double stiffening_energy() const { return stiffening_energy_; }

  SurfaceContactReport report(const Eigen::VectorXd& x) const;
  /// Of the touches with friction at x, by their speeds across the normal at velocities v (3n).
  SlidingCount count_sliding(const Eigen::VectorXd& x, const Eigen::VectorXd& v, double slip_speed) const;

  std::vector<double> memory() const;
  /// Returns what of `saved` was not its own.
  std::span<const double> restore(std::span<const double> saved);

 private:
  PairPenalty penalty_of(PairKind kind, const Candidate& c, const std::array<int, 4>& v) const;
  void find_active(const std::vector<Vec3>& x, std::vector<ActivePair>& active) const;
  double free_share(const std::vector<Vec3>& x, const std::vector<Vec3>& move) const;
  bool stiffen(std::span<const int> vertices);
  void count_stiffening(const std::vector<ActivePair>& before);

  std::unique_ptr<const ContactSurfaces> surfaces_;
  SurfaceContactSettings settings_;
  std::vector<double> mass_, material_;  // per contact vertex [kg], [N/m]; infinite for a collider's
  std::vector<double> base_;             // k at level 0, per vertex [N/m^2]
  std::vector<std::uint8_t> left_out_;   // per surface, or empty
  std::vector<std::uint8_t> level_;      // per vertex: k is 4^level times as large
  double softened_at_ = -1;              // time of the step that did it last [s]
  bool at_bound_ = false;
  double stiffening_energy_ = 0;
  ContactSurfaces::ColliderPath path_;
  double duration_ = 0;  // of the path [s]
  bool colliders_move_ = false;
  double progress_ = 1;
  Eigen::VectorXd x_start_;
  std::vector<ActivePair> touching_;
  // Results of the last positions asked for; evaluations come from one thread.
  mutable ContactCandidates candidates_;
  mutable Eigen::VectorXd x_active_;
  mutable double active_progress_ = -1;
  mutable std::vector<ActivePair> active_;
  mutable std::vector<int> stencils_;
  mutable std::vector<Vec3> positions_, moves_;
  mutable std::array<int, 4> blocking_{-1, -1, -1, -1};
};

/// Smoothed, lagged Coulomb friction between surfaces (friction_law.h): normal forces, tangent planes and nearest
/// points are those at the start of the step. `contact` must outlive the term, and begin its steps first.
std::unique_ptr<EnergyTerm> make_surface_friction(const SurfaceContact& contact, double slip_speed);

}  // namespace softreel::sim
