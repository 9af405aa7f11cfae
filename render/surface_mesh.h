#pragma once
// What is drawn of a body: triangles over render vertices, fixed for the whole clip. Positions come per frame.
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace softreel::render {

/// Triangles [first_triangle, first_triangle + triangle_count) wear one look.
struct MeshPart {
  std::size_t first_triangle = 0;
  std::size_t triangle_count = 0;
  std::size_t look = 0;  ///< index into the looks handed over with the mesh
};

/// Topology of a surface. The physics' vertices ("positions") are welded; a render vertex is one corner of the picture:
/// several of them share a position along a texture seam or a hard edge.
struct SurfaceMesh {
  std::size_t position_count = 0;          ///< length of the position arrays given per frame
  std::vector<std::uint32_t> position_of;  ///< per render vertex: index of its position, < position_count
  std::vector<std::uint32_t> normal_of;    ///< per render vertex: normal group; one smooth normal per group. Groups are
                                           ///< numbered from 0 without gaps. Empty: every position is one group
  std::vector<glm::vec2> uv;          ///< per render vertex, v upwards (OpenGL, OBJ); empty: no texture coordinates
  std::vector<glm::vec3> rest;        ///< per render vertex: place in the body's own space at rest [m]; empty: none
  std::vector<glm::uvec3> triangles;  ///< render vertices, counter-clockwise seen from the front
  std::vector<MeshPart> parts;        ///< empty: all triangles wear look 0
};

/// A mesh with positions: what the shapes below return.
struct Shape {
  SurfaceMesh mesh;
  std::vector<glm::vec3> positions;  ///< mesh.position_count, in the shape's own space [m]
};

/// Mesh without seams over welded triangles (position indices), every edge smooth until `group_by_crease` says
/// otherwise.
SurfaceMesh mesh_from_triangles(std::size_t position_count, std::span<const glm::uvec3> triangles);

/// Normal groups for a mesh whose file has no normals. Two triangles that share an edge (two positions) have a common
/// normal there when their planes meet at less than `crease_angle` [degrees]; a texture seam never parts them. A render
/// vertex that lies on a crease is split in two or more: vertices, uv and triangles of `mesh` change, parts and
/// triangle order do not. `positions`: position_count, at rest.
void group_by_crease(SurfaceMesh& mesh, std::span<const glm::vec3> positions, float crease_angle);

/// Normal groups from a file's normals: render vertices with the same position and the same normal (to about a degree)
/// share one. `normals`: one per render vertex, any length but zero.
void group_by_normals(SurfaceMesh& mesh, std::span<const glm::vec3> normals);

/// Throws std::invalid_argument naming the first thing that does not fit (index out of range, array of the wrong
/// length, part beyond the triangles, look >= look_count, normal groups with gaps).
void check_mesh(const SurfaceMesh& mesh, std::size_t look_count);

/// Shapes for colliders, centred on the origin, outward normals, with texture coordinates.
Shape make_plane(float size_x, float size_z, int cells = 1);  ///< in the xz plane, facing +y [m]
Shape make_sphere(float radius, int segments = 64);           ///< `segments` around, half as many from pole to pole
Shape make_box(const glm::vec3& size);                        ///< edge lengths [m], hard edges
/// Along y; `height` is that of the straight part between the two half spheres [m].
Shape make_capsule(float radius, float height, int segments = 48);

}  // namespace softreel::render
