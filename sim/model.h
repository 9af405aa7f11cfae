#pragma once
// What is simulated: masses, energies and what is held. Built once from the scene, then left alone.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/energy_term.h"
#include "sim/motion.h"
#include "sim/state.h"

namespace softreel::sim {

class ColliderContact;
class SurfaceContact;

/// Vertices that are held, or driven along a scripted motion.
struct Pin {
  std::vector<int> vertices;
  bool axes[3] = {true, true, true};  ///< which coordinates are held
  Motion motion;                      ///< moves them from where they are at the start
};

struct Model {
  std::vector<BodyRange> bodies;  ///< in increasing order, covering all vertices
  Eigen::VectorXd masses;         ///< lumped, one per vertex, n [kg] > 0
  Eigen::VectorXd x0, v0;         ///< at t = 0, 3n [m], [m/s]
  std::vector<Pin> pins;
  std::vector<std::unique_ptr<EnergyTerm>> potentials;        ///< E(x) [J]
  std::vector<std::unique_ptr<EnergyTerm>> dissipations;      ///< D(v) [W]; begin their steps after the potentials
  std::vector<std::unique_ptr<EnergyTerm>> mass_corrections;  ///< of bodies with consistent mass (mass.h)
  const ColliderContact* contact = nullptr;                   ///< the one among the potentials, if any

  SurfaceContact* surfaces = nullptr;  ///< contact between surfaces, among the potentials

  /// Per body: is it moved by what may change while it lies still (pins with a motion, loads with times, wind)? Empty:
  /// none is.
  std::vector<std::uint8_t> restless;

  int vertices() const { return static_cast<int>(masses.size()); }
};

/// Degrees of freedom that are held, and where: by pins, or because their body is asleep.
class Pins {
 public:
  explicit Pins(const Model& model);

  bool any() const { return any_; }
  /// 3n flags.
  const std::vector<std::uint8_t>& fixed() const { return fixed_; }
  /// From now on, bodies with a flag are held where they are, too.
  void hold(std::span<const std::uint8_t> bodies);
  /// x of every pinned degree of freedom := its scripted position at time t.
  void place(double t, Eigen::VectorXd& x) const;
  /// v of every pinned degree of freedom := its scripted velocity at time t, from before where it jumps.
  void drive(double t, Eigen::VectorXd& v) const;
  /// Does any of them move between two times?
  bool move(double from, double to) const;
  /// The farthest that any pin turns between two times [deg].
  double turn(double from, double to) const;
  /// vector of every held degree of freedom := 0.
  void zero(Eigen::VectorXd& vector) const;

 private:
  void fix();

  const Model& model_;
  std::vector<std::uint8_t> fixed_;
  bool any_ = false;
};

}  // namespace softreel::sim
