#pragma once
// The project's own shapes: what they are and how they are painted.
#include "assets/generate/paint.h"

namespace softreel::generate {

struct Model {
  std::string name;           ///< file name without extension
  Field surface;              ///< y up [m]
  Field edge_length;          ///< wanted length of the mesh's edges at a point [m]
  std::vector<Paint> paints;  ///< the first one everywhere
  Vec3 low, high;             ///< box around it [m]
};

Model dragon();      ///< chubby, standing on two feet, 1.35 m high, looking along +z
Model jelly_cube();  ///< with rounded edges, 1 m
Model jelly_star();  ///< five soft arms in the xy plane, 1 m
Model jelly_ring();  ///< a torus around y, 1 m
Model jelly_bear();  ///< a gummy bear, 1 m high

}  // namespace softreel::generate
