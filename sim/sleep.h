#pragma once
// Bodies that have come to rest, and are left out of steps until something touches them.
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/model.h"

namespace softreel::sim {

/// A body falls asleep when no vertex of it, nor of the bodies that it touches or is tied to (its island), has been
/// faster than `speed` for half a second; it stays where it is, as if all of it were pinned. What is given up is the
/// motion that would have followed: less than `speed`, the creep of friction below its slip speed above all.
///
/// An island wakes as a whole when another body, or a collider that moves, comes within the contact distance: the step
/// in which that happens is taken again from its start with the island awake, so no impulse is lost.
///
/// Never asleep: what has not moved yet (ten times as fast as `speed`: an unstable balance takes its time) unless all
/// of it is pinned, what is driven by pins, what loads that change or the wind act on (`Model::restless`), and what
/// touches a mesh collider with a motion.
class Sleep {
 public:
  /// `speed` [m/s] > 0. `model` must outlive this.
  Sleep(const Model& model, double speed);

  bool any() const { return sleeping_ > 0; }
  /// Can a step from t to t + h be left out? All are asleep, and no mesh collider moves, which may hit one on its way.
  bool all(double t, double h) const;
  int count() const { return sleeping_; }
  /// Per body of the model.
  const std::vector<std::uint8_t>& asleep() const { return asleep_; }

  /// Before a step from t to t + h: wakes what an analytic collider that moves in it has carried or comes to touch.
  /// True if there was any. x: 3n [m].
  bool wake_moved(const Eigen::VectorXd& x, double t, double h);
  /// After a step that came to x: wakes what was touched. True if there was any.
  bool wake_touched(const Eigen::VectorXd& x);
  /// After a step that did not hold: wakes what might have been touched in it. True if there was any.
  bool wake_near();
  /// After a step of h [s] that held: lets fall asleep what is at rest. True if there was any; the velocities of what
  /// sleeps are then to be set to zero.
  bool settle(const State& state, double h);

  std::vector<double> memory() const;
  /// Takes its part from the front of `saved` and returns the rest. Throws std::invalid_argument for another model's.
  std::span<const double> restore(std::span<const double> saved);

 private:
  template <class Each>
  void visit(int vertex, int other, const Each& each) const;
  template <class Each>
  void for_touching(const Eigen::VectorXd& x, const Each& each) const;
  void wake_if_met(int a, int b);
  void wake_island(int island);

  const Model& model_;
  double speed_;
  std::vector<int> body_of_;               // per vertex
  std::vector<std::pair<int, int>> tied_;  // bodies
  std::vector<std::uint8_t> asleep_, has_moved_;
  std::vector<double> calm_;  // for how long [s]
  std::vector<int> island_;   // of a body that is asleep: the lowest number in it
  int sleeping_ = 0;
};

}  // namespace softreel::sim
