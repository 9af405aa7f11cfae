#pragma once
// What a material can and what it cannot.

namespace softreel::sim {

struct MaterialTraits {
  bool rotation_invariant = true;     ///< turning the body costs nothing
  bool volume_term = true;            ///< false: Poisson's ratio 0 and Young's modulus 2 mu, whatever is given
  bool smooth_when_collapsed = true;  ///< twice differentiable where an element has collapsed to a line or a point
};

}  // namespace softreel::sim
