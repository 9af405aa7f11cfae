#pragma once
// Signs of orientation determinants without rounding errors: a floating-point filter first, exact expansion arithmetic
// where it cannot decide (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", Discrete & Computational Geometry 18, 1997). Exact as long as no product over- or underflows.
#include "sim/mesh.h"

namespace softreel::assets {

/// Sign of (b-a) x (c-a) . (d-a): +1 when d lies on the side that the normal of a b c points to.
int orient3d_sign(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, const sim::Vec3& d);

/// Sign of the area of a b c seen along axis `drop` (0, 1, 2), with the remaining axes in cyclic order.
int orient2d_sign(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c, int drop);

/// Whether the two triangles meet beyond the vertices and edges that they share by index. Exact.
/// Both must have area; with three shared vertices the answer is true.
bool triangles_cross(const std::vector<sim::Vec3>& vertices, const sim::Triangle& s, const sim::Triangle& t);

/// Whether a triangle has no area at all. Exact.
bool is_flat(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c);

}  // namespace softreel::assets
