#pragma once
// --set key=value: any key of the scene by its dotted path.
//
//   render.samples=4                   sections that the file leaves out are made
//   soft.spot.material.young=1e5       entries of a list by name
//   light.1.intensity=2                or by number, from 1
//   soft.*.look.color=red              or all of them; text needs no quotes
#include <span>
#include <string>
#include <vector>

#include "assets/error.h"
#include "assets/scene_tree.h"

namespace softreel::assets {

/// Puts the overrides into the tree, where they are read and checked like everything else; their nodes have the
/// override
/// ("--set render.samples=4") as file. Adds to `problems` what has no place in the tree.
void apply_overrides(Node& root, std::span<const std::string> overrides, std::vector<Problem>& problems);

}  // namespace softreel::assets
