#pragma once
// Which bodies nothing holds.
#include <string>
#include <vector>

#include "sim/model.h"

namespace softreel::sim {

struct FreeBody {
  std::string name;
  std::string axes;  ///< along which it, or a part of it, can be moved without any force: "x", "y and z", ...
};

/// Vertices that elements tie together are one piece, across bodies too; a piece is held along an axis if a pin holds
/// one of its vertices along it. Turns are not looked at: a body that can only turn (a pendulum, a sheet on two pins)
/// comes to rest under gravity.
std::vector<FreeBody> free_bodies(const Model& model);

}  // namespace softreel::sim
