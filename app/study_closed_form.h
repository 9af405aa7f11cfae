#pragma once
// The motion that a scene declares in [reference].
#include "app/study_reference.h"

namespace softreel::app {

/// Fills frames and points of `reference`, whose scene is set. Throws UserError (kUsage) for a formula that is not
/// finite somewhere, or that does not begin where the body does.
void evaluate_closed_form(const StudyPoints& points, const Shapes& shapes, StudyReference& reference);

}  // namespace softreel::app
