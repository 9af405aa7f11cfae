#pragma once
// How the coordinates of a mesh file become metres with y up: the keys `unit`, `up` and `size` of every mesh.
#include <optional>
#include <string_view>

#include "sim/mesh.h"

namespace softreel::assets {

/// Applied in this order: unit, up, size. All about the file's own origin, so that x = 0 stays x = 0.
struct MeshOptions {
  double unit = 1.0;           ///< length of the file's unit [m], > 0; see metres_per_unit for names
  char up = 'y';               ///< the file's up axis, 'x' | 'y' | 'z'; turned onto y by a rotation (no mirroring)
  std::optional<double> size;  ///< length of the longest side of the bounding box afterwards [m], > 0
};

/// "m", "cm", "mm", "um", "km", "in"/"inch", "ft"/"foot" and some long names; nothing for an unknown name.
std::optional<double> metres_per_unit(std::string_view name);

/// Names that `metres_per_unit` knows, for messages: "m, cm, mm, ...".
std::string_view unit_names();

/// The rotation of `up` (orthonormal, determinant 1): z goes to y (x stays), x goes to y (z stays).
Eigen::Matrix3d y_from_up(char up);

/// Turns file coordinates into metres, in place. Returns the factor all lengths were multiplied with.
/// Throws std::logic_error on options out of range (the scene reader checks them) and when `size` meets a point.
double apply_mesh_options(const MeshOptions& options, std::vector<sim::Vec3>& vertices);

}  // namespace softreel::assets
