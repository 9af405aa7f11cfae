#include "render/channels.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "render/camera.h"

namespace softreel::render {

namespace {

/// pack_direction of shader_geometry.cpp, backwards.
glm::vec3 unpack_direction(std::uint32_t word) {
  const glm::vec2 p = glm::unpackSnorm2x16(word);
  glm::vec3 n(p, 1 - std::abs(p.x) - std::abs(p.y));
  const float fold = std::max(-n.z, 0.0f);
  n.x += n.x < 0 ? fold : -fold;
  n.y += n.y < 0 ? fold : -fold;
  return glm::normalize(n);
}

}  // namespace

Channels channels_from_words(std::span<const glm::uvec4> words, std::span<const float> depth, int width, int height,
                             const glm::mat4& clip_from_world, const Camera& camera) {
  Channels channels{width, height, {}, {}, {}};
  const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(clip_from_world));
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (words[i].z < 0x01000000u) {
        channels.depth.push_back(std::numeric_limits<float>::infinity());
        channels.normal.emplace_back(0);
        channels.id.push_back(0);
        continue;
      }
      const glm::dvec4 clip((x + 0.5) * 2 / width - 1, (y + 0.5) * 2 / height - 1,
                            2.0 * static_cast<double>(depth[i]) - 1, 1);
      const glm::dvec4 at = world_from_clip * clip;
      channels.depth.push_back(
          static_cast<float>(glm::dot(glm::dvec3(at) / at.w - glm::dvec3(camera.position), forward)));
      channels.normal.push_back(unpack_direction(words[i].x));
      channels.id.push_back(static_cast<std::uint16_t>(words[i].w));
    }
  return channels;
}

std::vector<std::uint16_t> depth_samples(const Channels& channels) {
  std::vector<std::uint16_t> samples;
  samples.reserve(channels.depth.size());
  constexpr float kMost = 65535;
  for (const float depth : channels.depth)
    samples.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(1000 * depth, 0.0f, kMost))));
  return samples;
}

std::vector<std::uint16_t> normal_samples(const Channels& channels) {
  std::vector<std::uint16_t> samples;
  samples.reserve(3 * channels.normal.size());
  for (const glm::vec3& n : channels.normal)
    for (int c = 0; c < 3; ++c)
      samples.push_back(static_cast<std::uint16_t>(std::lround(32767.5f * (std::clamp(n[c], -1.0f, 1.0f) + 1))));
  return samples;
}

}  // namespace softreel::render
