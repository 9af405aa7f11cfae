#pragma once
// What a picture shows beside its colours: for compositing, and for tests.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace softreel::render {

/// Of the surface in the middle of each pixel, rows from top to bottom, width * height each.
struct Channels {
  int width = 0, height = 0;
  std::vector<float> depth;       ///< along the view from the camera [m]; infinite where nothing is
  std::vector<glm::vec3> normal;  ///< towards the viewer, world, unit length; 0 where nothing is
  std::vector<std::uint16_t> id;  ///< 0 nothing, 1 the ground, 2 and more: meshes in the order of add_mesh
};

struct Camera;

/// From what the geometry program has noted (shader_geometry.cpp, with ids): words and depths 0..1 of each pixel.
Channels channels_from_words(std::span<const glm::uvec4> words, std::span<const float> depth, int width, int height,
                             const glm::mat4& clip_from_world, const Camera& camera);

/// Millimetres, 65535 for 65.535 m and more, and for nothing.
std::vector<std::uint16_t> depth_samples(const Channels& channels);
/// Three of each pixel, 0..65535 for -1..1; 32768 everywhere where nothing is.
std::vector<std::uint16_t> normal_samples(const Channels& channels);

}  // namespace softreel::render
