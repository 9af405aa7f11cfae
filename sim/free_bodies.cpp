#include "sim/free_bodies.h"

#include <array>
#include <numeric>

namespace softreel::sim {

std::vector<FreeBody> free_bodies(const Model& model) {
  std::vector<int> parent(static_cast<size_t>(model.vertices()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[static_cast<size_t>(v)] != v) {
      auto& up = parent[static_cast<size_t>(v)];
      up = parent[static_cast<size_t>(up)];
      v = up;
    }
    return v;
  };
  for (const auto& term : model.potentials) {
    const auto k = static_cast<size_t>(term->stencil_size());
    const auto stencils = term->stencils();
    for (size_t e = 0; k > 1 && e < stencils.size() / k; ++e)
      for (size_t a = 1; a < k; ++a) parent[static_cast<size_t>(root(stencils[e * k + a]))] = root(stencils[e * k]);
  }
  std::vector<std::array<bool, 3>> held(parent.size(), {false, false, false});  // of each root
  for (const Pin& pin : model.pins)
    for (int v : pin.vertices)
      for (size_t axis = 0; axis < 3; ++axis)
        if (pin.axes[axis]) held[static_cast<size_t>(root(v))][axis] = true;

  std::vector<FreeBody> free;
  for (const BodyRange& body : model.bodies) {
    std::string axes;
    for (size_t axis = 0; axis < 3; ++axis) {
      bool all = true;
      for (int v = body.first; v < body.first + body.count; ++v) all = all && held[static_cast<size_t>(root(v))][axis];
      if (!all) axes += (axes.empty() ? "" : " and ") + std::string(1, "xyz"[axis]);
    }
    if (!axes.empty()) free.push_back({body.name, axes});
  }
  return free;
}

}  // namespace softreel::sim
