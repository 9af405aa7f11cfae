#pragma once
// The rotation in a deformation gradient.
#include "sim/principal.h"

namespace softreel::sim {

/// R of the polar decomposition F = R S, orthonormal columns, S symmetric. Solid: det R = 1, so that S of a reflection
/// has one negative eigenvalue, the smallest. Finite for every finite F.
Deformation<3> rotation_of(const Deformation<3>& F);
Deformation<2> rotation_of(const Deformation<2>& F);

/// The same in closed form, to a few roundings. Returns false, and no R, where that would lose digits: where two
/// principal stretches nearly sum to zero, or differ by a factor of ten.
bool closed_form_rotation(const Deformation<3>& F, Deformation<3>& R);

}  // namespace softreel::sim
