#include "render/gpu_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "render/shader_sources.h"
#include "render/smooth_normals.h"

namespace softreel::render {

GpuMesh::GpuMesh(const GlFunctions& gl, SurfaceMesh mesh, std::vector<Look> looks)
    : gl_(gl), mesh_(std::move(mesh)), looks_(std::move(looks)) {
  if (mesh_.parts.empty()) mesh_.parts.push_back({0, mesh_.triangles.size(), 0});
  normals_.resize(normal_group_count(mesh_));
  vertices_.resize(mesh_.position_of.size());

  index_buffer_ = make_buffer(gl, mesh_.triangles.size() * sizeof(glm::uvec3), mesh_.triangles.data(), 0);
  vertex_buffer_ = make_buffer(gl, vertices_.size() * sizeof(Vertex), nullptr, GL_DYNAMIC_STORAGE_BIT);
  vertex_array_ = make_vertex_array(gl);
  const GLuint array = *vertex_array_;
  gl.VertexArrayElementBuffer(array, *index_buffer_);
  gl.VertexArrayVertexBuffer(array, 0, *vertex_buffer_, 0, sizeof(Vertex));
  const auto attribute = [&](unsigned index, GLint size, GLuint offset, GLuint binding) {
    gl.EnableVertexArrayAttrib(array, index);
    gl.VertexArrayAttribFormat(array, index, size, GL_FLOAT, GL_FALSE, offset);
    gl.VertexArrayAttribBinding(array, index, binding);
  };
  attribute(kPositionAttribute, 3, 0, 0);
  attribute(kNormalAttribute, 3, sizeof(glm::vec3), 0);
  if (!mesh_.uv.empty()) {
    uv_buffer_ = make_buffer(gl, mesh_.uv.size() * sizeof(glm::vec2), mesh_.uv.data(), 0);
    gl.VertexArrayVertexBuffer(array, 1, *uv_buffer_, 0, sizeof(glm::vec2));
    attribute(kUvAttribute, 2, 0, 1);
  }
  if (std::any_of(looks_.begin(), looks_.end(), [](const Look& look) { return look.color_map.has_value(); })) {
    values_.resize(mesh_.position_of.size(), 0);
    value_buffer_ = make_buffer(gl, values_.size() * sizeof(float), values_.data(), GL_DYNAMIC_STORAGE_BIT);
    gl.VertexArrayVertexBuffer(array, 2, *value_buffer_, 0, sizeof(float));
    attribute(kValueAttribute, 1, 0, 2);
  }
  const bool patterned =
      std::any_of(looks_.begin(), looks_.end(), [](const Look& look) { return look.pattern != Pattern::kNone; });
  if (patterned && !mesh_.rest.empty()) set_rest(mesh_.rest);
  check_gl(gl, "set up a mesh");
}

void GpuMesh::set_rest(std::span<const glm::vec3> rest) {
  rest_buffer_ = make_buffer(gl_, rest.size_bytes(), rest.data(), 0);
  const GLuint array = *vertex_array_;
  gl_.VertexArrayVertexBuffer(array, 3, *rest_buffer_, 0, sizeof(glm::vec3));
  gl_.EnableVertexArrayAttrib(array, kRestAttribute);
  gl_.VertexArrayAttribFormat(array, kRestAttribute, 3, GL_FLOAT, GL_FALSE, 0);
  gl_.VertexArrayAttribBinding(array, kRestAttribute, 3);
}

void GpuMesh::set_rest_of_square(float half) {
  if (rest_buffer_) return;
  std::vector<glm::vec3> rest;
  for (const glm::vec3& p : positions_) rest.push_back(half * p);
  std::vector<glm::vec3> corners;
  for (const std::uint32_t position : mesh_.position_of) corners.push_back(rest[position]);
  set_rest(corners);
}

void GpuMesh::set_values(std::span<const float> values) {
  if (!is_field()) throw std::invalid_argument("values for a mesh whose looks have no colour map");
  if (values.size() != mesh_.position_count)
    throw std::invalid_argument(
        fmt::format("{} values for a mesh of {} positions", values.size(), mesh_.position_count));
  bool same = true;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const float value = values[mesh_.position_of[i]];
    same = same && values_[i] == value;
    values_[i] = value;
  }
  if (same) return;
  values_waiting_ = true;
  ++revision_;
}

void GpuMesh::set_positions(std::span<const glm::vec3> positions) {
  if (positions.size() != mesh_.position_count)
    throw std::invalid_argument(
        fmt::format("{} positions for a mesh that has {}", positions.size(), mesh_.position_count));
  const bool same = positions_.size() == positions.size() && !positions.empty() &&
                    std::memcmp(positions_.data(), positions.data(), positions.size_bytes()) == 0;
  if (same) return;
  positions_.assign(positions.begin(), positions.end());
  bounds_ = {};
  bounds_.add(positions);
  waiting_ = true;
  ++revision_;
}

void GpuMesh::upload(RenderCounters& counters) {
  if (values_waiting_) {
    values_waiting_ = false;
    gl_.NamedBufferSubData(*value_buffer_, 0, static_cast<GLsizeiptr>(values_.size() * sizeof(float)), values_.data());
  }
  if (!waiting_) return;
  waiting_ = false;
  compute_smooth_normals(mesh_, positions_, normals_);
  const std::span<const std::uint32_t> group_of = mesh_.normal_of.empty() ? mesh_.position_of : mesh_.normal_of;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    vertices_[i] = {positions_[mesh_.position_of[i]], normals_[group_of[i]]};
  gl_.NamedBufferSubData(*vertex_buffer_, 0, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)),
                         vertices_.data());
  ++counters.mesh_uploads;
}

void GpuMesh::draw(std::size_t first_triangle, std::size_t triangle_count) const {
  gl_.BindVertexArray(*vertex_array_);
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangle_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first_triangle * sizeof(glm::uvec3)));
}

Bounds GpuMesh::world_bounds() const {
  if (bounds_.empty()) return {};
  const glm::vec3 centre(world_from_mesh * glm::vec4(bounds_.centre(), 1));
  const glm::vec3 half = 0.5f * (bounds_.high - bounds_.low);
  glm::vec3 reach(0);
  for (int axis = 0; axis < 3; ++axis) reach += glm::abs(glm::vec3(world_from_mesh[axis])) * half[axis];
  return {centre - reach, centre + reach};
}

}  // namespace softreel::render
