#pragma once
// What the runs of a study are measured against, and how far that can be trusted.
#include <filesystem>
#include <string>
#include <vector>

#include "app/study_points.h"
#include "app/study_sweep.h"
#include "app/trial.h"

namespace softreel::app {

struct StudyReference {
  std::string what;                      ///< "the closed form", "rk4, 512 substeps"
  std::string hash;                      ///< of all that it depends on
  std::vector<CachedFrame> frames;       ///< states for camera and pictures; of `scene`
  assets::Scene scene;                   ///< whose meshes the frames have
  std::vector<Eigen::Matrix3Xd> points;  ///< where the points belong, each frame [m]
  double floor = 0;                      ///< its own error: largest over the frames of the RMS [m]; 0: rounding alone
  double order = 0;                      ///< at which its last levels converged; 0: not measured
  double size = 1;                       ///< diagonal of the box around the bodies, at the start [m]
};

/// The closed form that the scene declares, or else a run with far more substeps, of rk4 where it holds and of bdf2
/// where it does not (static: of static), doubled until it has more than they and its own error is below `size` times
/// 1e-11, it has 64 times the substeps of the sweep, or `seconds` are over. Its error is that of Richardson's
/// extrapolation over the last levels (Roache 1994, "Perspective: a method for uniform reporting of grid refinement
/// studies").
///
/// Kept in `folder`, so that it is computed once. Throws UserError: kUsage when `seconds` are not enough or the closed
/// form does not start where the body does; kSimulation when no method holds; as ClipWorld for a scene that cannot be
/// built. Throws Interrupted.
StudyReference make_reference(const SweepRequest& request, const Sweep& sweep, const StudyPoints& points,
                              SharedShapes& shapes, const std::filesystem::path& folder, double seconds, bool quiet);

}  // namespace softreel::app
