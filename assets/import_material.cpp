#include "assets/import_material.h"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <system_error>

namespace softreel::assets {
namespace {

std::optional<double> number(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  ai_real value = 0;
  if (material.Get(key, type, index, value) != AI_SUCCESS || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> fraction(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  const auto value = number(material, key, type, index);
  return value ? std::optional(std::clamp(*value, 0.0, 1.0)) : std::nullopt;
}

std::optional<std::array<double, 3>> color(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  aiColor4D c;
  if (material.Get(key, type, index, c) != AI_SUCCESS) return std::nullopt;
  if (!std::isfinite(c.r + c.g + c.b)) return std::nullopt;
  return std::array<double, 3>{std::clamp<double>(c.r, 0, 1), std::clamp<double>(c.g, 0, 1),
                               std::clamp<double>(c.b, 0, 1)};
}

/// assimp gives a grey and no texture to what has no material, and the grey 0.6 to one whose MTL is missing.
bool made_up(const aiMaterial& material) {
  aiString texture;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    if (material.GetTexture(type, 0, &texture) == AI_SUCCESS) return false;
  }
  const auto diffuse = color(material, AI_MATKEY_COLOR_DIFFUSE);
  if (!diffuse) return false;
  aiString name;
  const bool unnamed = material.Get(AI_MATKEY_NAME, name) != AI_SUCCESS || name == aiString(AI_DEFAULT_MATERIAL_NAME);
  const bool grey = (*diffuse)[0] == (*diffuse)[1] && (*diffuse)[1] == (*diffuse)[2];
  return grey && (unnamed || (*diffuse)[0] == 0.6f);
}

/// A Phong exponent as roughness: alpha^2 = 2 / (exponent + 2) (Walter et al., "Microfacet models for refraction",
/// 2007, section 5.2), roughness = sqrt(alpha). Only for highlights that are there.
std::optional<double> roughness_of_phong(const aiMaterial& material) {
  const auto exponent = number(material, AI_MATKEY_SHININESS);
  const auto specular = color(material, AI_MATKEY_COLOR_SPECULAR);
  if (!exponent || *exponent <= 0 || !specular) return std::nullopt;
  if (std::max({(*specular)[0], (*specular)[1], (*specular)[2]}) <= 0) return std::nullopt;
  return std::pow(2.0 / (*exponent + 2.0), 0.25);
}

/// Files name textures with the paths of the machine they were made on: as it is, then by its name alone nearby.
std::filesystem::path find_texture(std::string name, const std::filesystem::path& folder) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path(name);
  for (const auto& candidate : {folder / path, folder / path.filename(), folder / "textures" / path.filename()}) {
    std::error_code error;
    if (std::filesystem::is_regular_file(candidate, error)) return std::filesystem::absolute(candidate, error);
  }
  return {};
}

TextureSource import_texture(const aiScene& scene, const aiMaterial& material,
                             std::initializer_list<aiTextureType> types, const std::filesystem::path& folder,
                             std::vector<std::string>& missing) {
  TextureSource texture;
  for (const aiTextureType type : types) {
    aiString name;
    if (material.GetTexture(type, 0, &name) != AI_SUCCESS || name.length == 0) continue;
    if (const aiTexture* embedded = scene.GetEmbeddedTexture(name.C_Str())) {
      if (embedded->mHeight == 0 && embedded->mWidth > 0) {  // encoded bytes; raw pixels are not kept
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
        texture.bytes.assign(bytes, bytes + embedded->mWidth);
        return texture;
      }
    } else if (texture.file = find_texture(name.C_Str(), folder); !texture.file.empty()) {
      return texture;
    }
    if (std::find(missing.begin(), missing.end(), name.C_Str()) == missing.end()) missing.push_back(name.C_Str());
    return texture;
  }
  return texture;
}

}  // namespace

SurfacePart import_material(const aiScene& scene, const aiMesh& mesh, const std::filesystem::path& folder,
                            std::vector<std::string>& missing) {
  SurfacePart part;
  part.name = mesh.mName.C_Str();
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return part;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiString name;
  material.Get(AI_MATKEY_NAME, name);
  if (made_up(material)) return part;
  if (name.length > 0) part.name = name.C_Str();
  part.base_color = color(material, AI_MATKEY_BASE_COLOR);
  if (!part.base_color) part.base_color = color(material, AI_MATKEY_COLOR_DIFFUSE);
  part.metallic = fraction(material, AI_MATKEY_METALLIC_FACTOR);
  part.roughness = fraction(material, AI_MATKEY_ROUGHNESS_FACTOR);
  if (!part.roughness) part.roughness = roughness_of_phong(material);
  const auto texture = [&](std::initializer_list<aiTextureType> types) {
    return import_texture(scene, material, types, folder, missing);
  };
  part.texture = texture({aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  part.normal_texture = texture({aiTextureType_NORMALS});
  part.roughness_texture = texture({aiTextureType_DIFFUSE_ROUGHNESS, aiTextureType_METALNESS});
  part.emission_texture = texture({aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR});
  part.emission = color(material, AI_MATKEY_COLOR_EMISSIVE);
  if (part.emission && *part.emission == std::array<double, 3>{}) part.emission.reset();
  return part;
}

}  // namespace softreel::assets
