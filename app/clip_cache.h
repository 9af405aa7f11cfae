#pragma once
// The simulated frames of a clip on disk, one file each, from which an interrupted simulation goes on.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/simulation.h"
#include "sim/state.h"

namespace softreel::app {

/// Of a frame whose steps time.accuracy has chosen.
struct FrameAccuracy {
  double estimate = 0;      ///< of its error, in the unit that was asked for
  double coarse_steps = 0;  ///< steps of the runs that the estimate took beside the clip's own; at frame 1
  bool met = true;          ///< the estimate can be relied on, and is small enough in every frame
};

/// Of contact between surfaces, in a frame.
struct ContactFigures {
  double candidates = 0, active = 0;  ///< pairs of features: looked at, within the contact distance
  double smallest_gap = 0;            ///< of the active ones [m]; 0: there are none
  double deepest = 0;                 ///< deepest intrusion into the contact distance, as a share of it
  double crossings = 0;               ///< pairs of triangles that cross
  double sticks = 0, slips = 0;       ///< touches with friction that hold, that slide
  double stiffenings = 0;             ///< solves that were taken again with more stiffness, since the frame before
  double stiffening_energy = 0;       ///< that this has added since the start [J]
};

/// What a frame tells beside its state: counts and energies since the frame before.
struct FrameFigures {
  sim::Energies energies;
  double steps = 0, newton_iterations = 0, linear_iterations = 0, retried_steps = 0;
  double residual = 0;  ///< the worst of those steps (sim::StepReport)
  double inverted = 0;  ///< tetrahedra that are inside out, in this frame
  std::optional<FrameAccuracy> accuracy;
  std::optional<ContactFigures> contact;  ///< where surfaces can touch
  std::optional<double> momentum_drift;   ///< MomentumWatch::drift, where momentum is kept
  std::optional<double> asleep;           ///< bodies, where they can fall asleep
};

/// Of one field.
struct CachedField {
  Eigen::VectorXd value, rate;  ///< Field::value, Field::rate
  std::vector<double> memory;   ///< Field::memory
};

struct CachedFrame {
  sim::State state;            ///< of the bodies; its time is that of the fields, too
  std::vector<double> memory;  ///< Simulation::memory
  FrameFigures figures;
  std::vector<CachedField> fields;  ///< as scene.fields
  Eigen::VectorXd contact_force;    ///< Simulation::contact_forces, where some body shows pressure (else empty)
};

class ClipCache {
 public:
  /// Frames live in folder/sim_HASH; nothing is written before the first `write`.
  ClipCache(std::filesystem::path folder, std::string simulation_hash);

  const std::filesystem::path& folder() const { return folder_; }
  /// Of another run of the same simulation, in a folder beside this one.
  ClipCache beside(const std::string& name) const;
  void remove() const;  ///< the folder and what is in it
  void write(int frame, const CachedFrame& data) const;
  /// Nothing if missing, damaged, of another simulation, or not of `vertices` vertices (-1: any).
  std::optional<CachedFrame> read(int frame, int vertices = -1) const;
  /// How many frames from 1 on are there and whole, at most `last`.
  int complete_frames(int last) const;

 private:
  std::filesystem::path file(int frame) const;
  std::string hash_of(int frame) const;

  std::filesystem::path folder_;
  std::string hash_;
};

}  // namespace softreel::app
