#include "app/drawn_surface.h"

#include <memory>

#include "app/convert.h"
#include "render/image_io.h"
#include "sim/motion.h"

namespace softreel::app {
namespace {

using Picture = std::shared_ptr<const render::Image>;

Picture picture_of(const assets::TextureSource& texture, const std::string& name) {
  if (!texture.bytes.empty()) {
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(texture.bytes.data()),
                                           texture.bytes.size());
    return std::make_shared<render::Image>(render::load_image(bytes, "embedded texture of '" + name + "'"));
  }
  if (!texture.file.empty()) return std::make_shared<render::Image>(render::load_image(texture.file));
  return nullptr;
}

Picture picture_of(const assets::Scene& scene, const std::string& written) {
  if (written.empty()) return nullptr;
  return std::make_shared<render::Image>(render::load_image(scene.asset_path(written)));
}

/// Per render vertex, upright in the body's own space: a pattern follows the body's turns.
std::vector<glm::vec3> rest_places(const assets::ImportedSurface& surface, const assets::Transform& transform,
                                   const render::SurfaceMesh& mesh) {
  const Eigen::Matrix3d upright = sim::euler_xyz(transform.rotate).transpose();
  std::vector<glm::vec3> rest;
  for (const std::uint32_t position : mesh.position_of)
    rest.push_back(to_glm(Eigen::Vector3d(upright * (surface.welded.vertices[position] - transform.translate))));
  return rest;
}

/// What the file says, where the scene does not.
void take_from_file(const assets::SurfacePart& part, const assets::Look& look, render::Look& l) {
  if (part.base_color) {
    const auto& c = *part.base_color;
    l.color = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
  }
  if (part.metallic) l.metallic = static_cast<float>(*part.metallic);
  if (part.roughness) l.roughness = static_cast<float>(*part.roughness);
  l.texture = picture_of(part.texture, part.name);
  if (l.texture && !part.base_color) l.color = glm::vec3(1);
  if (!l.normal_texture) l.normal_texture = picture_of(part.normal_texture, part.name);
  if (!l.roughness_texture) {
    l.roughness_texture = picture_of(part.roughness_texture, part.name);
    // Its values are meant as they are, where no factors stand beside.
    if (l.roughness_texture && !part.roughness) l.roughness = 1;
    if (l.roughness_texture && !part.metallic) l.metallic = 1;
  }
  if (look.emission || l.emission_texture) return;
  l.emission_texture = picture_of(part.emission_texture, part.name);
  if (part.emission) {
    const auto& e = *part.emission;
    l.emission = glm::vec3(static_cast<float>(e[0]), static_cast<float>(e[1]), static_cast<float>(e[2])) *
                 static_cast<float>(look.emission_strength);
  } else if (l.emission_texture) {
    l.emission = glm::vec3(static_cast<float>(look.emission_strength));
  }
}

}  // namespace

render::Look plain_look(const assets::Scene& scene, const assets::Look& look, bool two_sided) {
  render::Look result;
  if (look.color) result.color = to_linear(*look.color);
  result.roughness = static_cast<float>(look.roughness);
  result.metallic = static_cast<float>(look.metallic);
  result.sheen = static_cast<float>(look.sheen);
  result.two_sided = two_sided;
  if (look.back_color) result.back_color = to_linear(*look.back_color);
  result.texture = picture_of(scene, look.texture);
  if (result.texture && !look.color) result.color = glm::vec3(1);
  result.normal_texture = picture_of(scene, look.normal_texture);
  result.roughness_texture = picture_of(scene, look.roughness_texture);
  result.emission_texture = picture_of(scene, look.emission_texture);
  if (look.emission || result.emission_texture)
    result.emission =
        (look.emission ? to_linear(*look.emission) : glm::vec3(1)) * static_cast<float>(look.emission_strength);
  result.pattern = static_cast<render::Pattern>(look.pattern);
  result.pattern_color = to_linear(look.pattern_color);
  result.pattern_size = static_cast<float>(look.pattern_size);
  if (look.wire) result.wire = to_linear(*look.wire);
  return result;
}

DrawnSurface drawn_surface(const assets::Scene& scene, const assets::ImportedSurface& surface, int position_count,
                           const assets::Look& look, const assets::Transform& transform, bool two_sided) {
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
  if (look.pattern != assets::Pattern::kNone) mesh.rest = rest_places(surface, transform, mesh);
  for (const assets::SurfacePart& part : surface.parts) {
    mesh.parts.push_back({static_cast<std::size_t>(part.first_triangle), static_cast<std::size_t>(part.triangle_count),
                          drawn.looks.size()});
    render::Look l = plain_look(scene, look, two_sided);
    if (!look.color && look.texture.empty()) take_from_file(part, look, l);
    drawn.looks.push_back(std::move(l));
  }
  return drawn;
}

}  // namespace softreel::app
