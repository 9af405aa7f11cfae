#pragma once
// All that a picture depends on: where it equals that of the picture before, that one is the answer.
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/camera.h"
#include "render/environment.h"
#include "render/light.h"

namespace softreel::render {

struct PictureInputs {
  struct Mesh {
    std::size_t revision = 0;  ///< GpuMesh::revision: of positions and values
    glm::mat4 world_from_mesh{1};
    bool visible = true, casts_shadow = true;
    bool operator==(const Mesh&) const = default;
  };
  Camera camera;
  std::vector<Light> lights;
  Environment environment;
  std::uint32_t seed = 0;
  std::vector<Mesh> meshes;
  bool operator==(const PictureInputs&) const = default;
};

}  // namespace softreel::render
