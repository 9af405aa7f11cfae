#pragma once
// Vertex normals of a mesh that deforms.
#include <glm/glm.hpp>
#include <span>

#include "render/surface_mesh.h"

namespace softreel::render {

/// Unit normal of every normal group of `mesh` at these positions. Each corner adds its face's normal weighted by
/// sin(angle) / (product of the lengths of the two edges that meet there): exact for vertices on a sphere, and no
/// trigonometry (N. Max, "Weights for Computing Vertex Normals from Facet Normals", J. Graphics Tools 4(2), 1999).
/// Summed in triangle order: the same bits every time. A group without any area gets +y.
/// `positions`: mesh.position_count; `normals`: as many as there are groups (normal_group_count).
void compute_smooth_normals(const SurfaceMesh& mesh, std::span<const glm::vec3> positions,
                            std::span<glm::vec3> normals);

std::size_t normal_group_count(const SurfaceMesh& mesh);

}  // namespace softreel::render
