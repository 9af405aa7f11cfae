#pragma once
// A surface on the GPU side: topology once, positions and normals as often as they change.
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "render/bounds.h"
#include "render/counters.h"
#include "render/gl_objects.h"
#include "render/look.h"
#include "render/surface_mesh.h"

namespace softreel::render {

class GpuMesh {
 public:
  GpuMesh(const GlFunctions& gl, SurfaceMesh mesh, std::vector<Look> looks);

  /// Keeps the positions for the next upload, unless they are the ones already there. `positions`: mesh.position_count.
  void set_positions(std::span<const glm::vec3> positions);
  /// Keeps the values of a field for the next upload. `values`: mesh.position_count.
  void set_values(std::span<const float> values);
  /// Normals and upload, when positions are waiting; counts it.
  void upload(RenderCounters& counters);
  /// Draws triangles [first, first + count).
  void draw(std::size_t first_triangle, std::size_t triangle_count) const;

  /// Another number whenever positions or values are others.
  std::size_t revision() const { return revision_; }
  bool has_positions() const { return !positions_.empty(); }
  std::size_t position_count() const { return mesh_.position_count; }
  std::size_t triangle_count() const { return mesh_.triangles.size(); }
  /// Whether a look of it shows both sides.
  bool two_sided() const {
    return std::any_of(looks_.begin(), looks_.end(), [](const Look& look) { return look.two_sided; });
  }
  bool is_field() const { return static_cast<bool>(value_buffer_); }
  bool has_rest() const { return static_cast<bool>(rest_buffer_); }
  /// Rest coordinates of a square of half that size, for the ground's pattern; made once [m].
  void set_rest_of_square(float half);
  bool has_uv() const { return !mesh_.uv.empty(); }
  std::span<const MeshPart> parts() const { return mesh_.parts; }
  const Look& look(std::size_t index) const { return looks_[index]; }
  std::span<const Look> looks() const { return looks_; }
  GLuint vertex_array() const { return *vertex_array_; }
  /// World-space box of the mesh's own box, turned and moved.
  Bounds world_bounds() const;

  glm::mat4 world_from_mesh{1};
  bool visible = true;
  bool casts_shadow = true;

 private:
  void set_rest(std::span<const glm::vec3> rest);

  struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
  };

  const GlFunctions& gl_;
  SurfaceMesh mesh_;
  std::vector<Look> looks_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<Vertex> vertices_;
  Bounds bounds_;  ///< mesh space
  bool waiting_ = false;
  std::size_t revision_ = 0;
  std::vector<float> values_;  ///< per render vertex, of a field
  bool values_waiting_ = false;
  GlBuffer vertex_buffer_;
  GlBuffer uv_buffer_;
  GlBuffer value_buffer_;
  GlBuffer rest_buffer_;
  GlBuffer index_buffer_;
  GlVertexArray vertex_array_;
};

}  // namespace softreel::render
