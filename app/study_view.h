#pragma once
// Where the scene's camera sees points: errors in pixels.
#include <Eigen/Core>
#include <glm/glm.hpp>

#include "app/clip_extent.h"

namespace softreel::app {

class StudyView {
 public:
  /// `extent`: of the reference, for cameras that frame the clip.
  StudyView(const assets::Scene& scene, const ClipExtent& extent);

  /// Distance in the picture between two points [m] of the world [pixels]. Points that are not in front of the camera
  /// are seen nowhere: 0 if neither is, infinity if one of them is.
  double apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 private:
  glm::dmat4 clip_from_world_;
  double width_, height_;
};

}  // namespace softreel::app
