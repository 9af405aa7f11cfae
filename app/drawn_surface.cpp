#include "app/drawn_surface.h"

#include <memory>

#include "app/convert.h"
#include "render/image_io.h"

namespace softreel::app {
namespace {

std::shared_ptr<const render::Image> texture_of(const assets::SurfacePart& part) {
  if (!part.texture_bytes.empty()) {
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(part.texture_bytes.data()),
                                           part.texture_bytes.size());
    return std::make_shared<render::Image>(render::load_image(bytes, "embedded texture of '" + part.name + "'"));
  }
  if (!part.texture_file.empty()) return std::make_shared<render::Image>(render::load_image(part.texture_file));
  return nullptr;
}

}  // namespace

render::Look plain_look(const assets::Look& look, const std::optional<std::filesystem::path>& texture, bool two_sided) {
  render::Look result;
  if (look.color) result.color = to_linear(*look.color);
  result.roughness = static_cast<float>(look.roughness);
  result.metallic = static_cast<float>(look.metallic);
  result.two_sided = two_sided;
  if (look.back_color) result.back_color = to_linear(*look.back_color);
  if (texture) {
    result.texture = std::make_shared<render::Image>(render::load_image(*texture));
    if (!look.color) result.color = glm::vec3(1);
  }
  return result;
}

DrawnSurface drawn_surface(const assets::ImportedSurface& surface, int position_count, const assets::Look& look,
                           const std::optional<std::filesystem::path>& texture, bool two_sided) {
  DrawnSurface drawn;
  render::SurfaceMesh& mesh = drawn.mesh;
  mesh.position_count = static_cast<std::size_t>(position_count);
  for (int p : surface.position_of) mesh.position_of.push_back(static_cast<std::uint32_t>(p));
  for (const Eigen::Vector2f& uv : surface.uv) mesh.uv.emplace_back(uv.x(), uv.y());
  for (const sim::Triangle& t : surface.triangles)
    mesh.triangles.emplace_back(static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2]));
  if (!surface.normals.empty()) {
    std::vector<glm::vec3> normals;
    for (const Eigen::Vector3f& n : surface.normals) normals.emplace_back(n.x(), n.y(), n.z());
    render::group_by_normals(mesh, normals);
  } else {
    std::vector<glm::vec3> rest(mesh.position_count, glm::vec3(0));
    for (size_t i = 0; i < surface.welded.vertices.size() && i < rest.size(); ++i)
      rest[i] = to_glm(surface.welded.vertices[i]);
    render::group_by_crease(mesh, rest, static_cast<float>(look.crease));
  }
  for (const assets::SurfacePart& part : surface.parts) {
    mesh.parts.push_back({static_cast<std::size_t>(part.first_triangle), static_cast<std::size_t>(part.triangle_count),
                          drawn.looks.size()});
    render::Look l = plain_look(look, texture, two_sided);
    if (!look.color && !texture) {  // the file's own
      if (part.base_color) {
        const auto& c = *part.base_color;
        l.color = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
      }
      if (part.metallic) l.metallic = static_cast<float>(*part.metallic);
      if (part.roughness) l.roughness = static_cast<float>(*part.roughness);
      l.texture = texture_of(part);
      if (l.texture && !part.base_color) l.color = glm::vec3(1);
    }
    drawn.looks.push_back(std::move(l));
  }
  return drawn;
}

}  // namespace softreel::app
