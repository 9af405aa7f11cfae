#pragma once
// What is wrong with a run: positions against a reference, and what should have stayed as it was.
#include <optional>
#include <vector>

#include "app/study_points.h"
#include "app/study_view.h"
#include "app/trial.h"

namespace softreel::app {

/// Distances between where points are and where they should be. RMS: over all points of a frame.
struct PositionErrors {
  double end = 0;         ///< RMS in the last frame [m]
  double clip = 0;        ///< RMS over all points and frames [m]
  double worst = 0;       ///< largest over the frames of the RMS [m]: what plots show and percentages are made of
  double largest = 0;     ///< of one point in one frame [m]
  double end_px = 0;      ///< as `end`, in the picture [pixels]
  double largest_px = 0;  ///< as `largest`, in the picture [pixels]
};

/// Absent: the scene has nothing of the kind, or does not keep it.
struct Drifts {
  std::optional<double> energy;  ///< largest change of the total over the largest kinetic energy [-]
  std::optional<double>
      momentum;  ///< largest deviation of M v from M (v0 + g t), over M times the largest RMS speed [-]
  std::optional<double> angular;      ///< largest change about the centre of mass, over M times speed times size [-]
  std::optional<double> volume;       ///< of soft bodies, largest relative change of one of them [-]
  std::optional<double> penetration;  ///< deepest vertex inside a collider in any frame [m]
  std::optional<double> pins;         ///< farthest that a held vertex is from where it belongs [m]
};

/// `actual` and `expected`: points of each frame, 3 x n [m], as many frames. `view` may be null.
PositionErrors position_errors(const std::vector<Eigen::Matrix3Xd>& actual,
                               const std::vector<Eigen::Matrix3Xd>& expected, const StudyView* view);

/// Of the frames of a whole run. `size`: of the scene [m].
Drifts drifts(const assets::Scene& scene, const Shapes& shapes, const Trial& trial, double size);

/// Energy with all that left it, in each frame, less that of the first [J].
std::vector<double> energy_changes(const Trial& trial);

}  // namespace softreel::app
