// The worker's side of the import: assimp's scene becomes one RawSurface.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "assets/import_material.h"
#include "assets/raw_surface.h"
#include "assets/worker_protocol.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace softreel::assets {
namespace {

/// A mesh at one place of the node tree.
struct Placed {
  unsigned mesh;
  aiMatrix4x4 transform;
};

std::vector<Placed> place_meshes(const aiScene& scene) {
  std::vector<Placed> placed;
  std::vector<std::pair<const aiNode*, aiMatrix4x4>> stack;  // not recursive: a file decides the depth
  if (scene.mRootNode) stack.emplace_back(scene.mRootNode, scene.mRootNode->mTransformation);
  while (!stack.empty()) {
    const auto [node, transform] = stack.back();
    stack.pop_back();
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] < scene.mNumMeshes) placed.push_back({node->mMeshes[i], transform});
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) {
      stack.emplace_back(node->mChildren[i], transform * node->mChildren[i]->mTransformation);
    }
  }
  return placed;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d e;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) e(r, c) = static_cast<double>(m[static_cast<unsigned>(r)][c]);
  }
  return e;
}

/// Vertices of one placed mesh, appended.
void add_vertices(RawSurface& raw, const aiMesh& mesh, const Eigen::Matrix4d& world_from_mesh, bool uv, bool normals) {
  const Eigen::Matrix3d linear = world_from_mesh.topLeftCorner<3, 3>();
  const Eigen::Matrix3d cofactor = linear.determinant() * linear.inverse().transpose();  // of normals; any scale
  const Eigen::Matrix3d turn = linear.determinant() < 0 ? Eigen::Matrix3d(-cofactor) : cofactor;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    raw.positions.push_back(linear * sim::Vec3(p.x, p.y, p.z) + sim::Vec3(world_from_mesh.topRightCorner<3, 1>()));
    if (uv) {
      Eigen::Vector2f t = Eigen::Vector2f::Zero();
      if (mesh.mTextureCoords[0]) t = {mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y};
      raw.uv.push_back(t.allFinite() ? t : Eigen::Vector2f::Zero());
    }
    if (normals) {
      const sim::Vec3 n = turn * sim::Vec3(mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z);
      const double length = n.norm();
      const bool usable = std::isfinite(length) && length > 0;
      raw.normals.push_back(usable ? Eigen::Vector3f((n / length).cast<float>()) : Eigen::Vector3f(0, 1, 0));
    }
  }
}

/// Its triangles; false when a face names a vertex that is not there.
bool add_triangles(RawSurface& raw, const aiMesh& mesh, std::size_t first_vertex, bool mirrored) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) {
      ++raw.dropped_other;
      continue;
    }
    sim::Triangle t;
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) return false;
      t[k] = static_cast<int>(first_vertex + face.mIndices[k]);
    }
    if (mirrored) std::swap(t[1], t[2]);
    raw.triangles.push_back(t);
  }
  return true;
}

RawSurface convert(const aiScene& scene, const std::filesystem::path& file, std::size_t triangle_limit) {
  RawSurface raw;
  const std::vector<Placed> placed = place_meshes(scene);
  std::size_t faces = 0, vertices = 0;
  // STL says nothing of smooth surfaces and colours, OFF nothing of colours: what assimp makes up is left out.
  const std::string format = lower(file.extension().string());
  const bool colorless = format == ".stl" || format == ".off";
  bool uv = false, normals = format != ".stl";
  for (const Placed& p : placed) {
    const aiMesh& mesh = *scene.mMeshes[p.mesh];
    faces += mesh.mNumFaces;
    vertices += mesh.mNumVertices;
    uv = uv || mesh.mTextureCoords[0];
    normals = normals && mesh.mNormals;
    if (faces > triangle_limit || vertices > 3 * triangle_limit) {
      raw.error = fmt::format("has more than {} triangles; simplify the mesh", triangle_limit);
      return raw;
    }
  }
  for (const Placed& p : placed) {
    const aiMesh& mesh = *scene.mMeshes[p.mesh];
    if (!mesh.mVertices) continue;
    SurfacePart part;
    if (!colorless) part = import_material(scene, mesh, file.parent_path(), raw.missing_textures);
    part.first_triangle = static_cast<int>(raw.triangles.size());
    const std::size_t first_vertex = raw.positions.size();
    const Eigen::Matrix4d transform = matrix(p.transform);
    add_vertices(raw, mesh, transform, uv, normals);
    if (!add_triangles(raw, mesh, first_vertex, transform.topLeftCorner<3, 3>().determinant() < 0)) {
      raw.error = "a face names a vertex that is not there; the file is broken, export it again";
      return raw;
    }
    part.triangle_count = static_cast<int>(raw.triangles.size()) - part.first_triangle;
    if (part.triangle_count > 0) raw.parts.push_back(std::move(part));
  }
  return raw;
}

}  // namespace

std::string import_task(const std::string& input) {
  BlobReader request(input);
  const std::filesystem::path file = request.text();
  const auto triangle_limit = static_cast<std::size_t>(request.value<std::uint64_t>());
  RawSurface raw;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (scene) {
    raw = convert(*scene, file, triangle_limit);
  } else {
    raw.error = fmt::format("cannot be imported ({}); check that it is complete and of the format its name says",
                            importer.GetErrorString());
  }
  return write_raw(raw);
}

}  // namespace softreel::assets
