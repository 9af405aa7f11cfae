#pragma once
// Light from a picture of all directions (an equirectangular HDR file): irradiance, mirror images, sample directions.
#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "render/light.h"

namespace softreel::render {

/// Linear radiance of all directions, rows from straight up to straight down; the middle column is towards -z.
struct HdrImage {
  int width = 0, height = 0;      ///< [px]
  std::vector<glm::vec3> pixels;  ///< width * height, finite, >= 0
  std::size_t mended = 0;  ///< pixels of the file that were not finite or negative (taken as black), or beyond 1e6
                           ///< (taken as that)
};

/// Reads Radiance .hdr (and, as radiance 0..1, what load_image reads). Throws RenderError (kInput).
HdrImage load_hdr(const std::filesystem::path& path);

class Panorama {
 public:
  /// `strength`: factor on all of it; `turn`: about the vertical [degrees], counter-clockwise seen from above.
  Panorama(const HdrImage& image, float strength, float turn);

  /// Spherical harmonics of order 2 such that their sum over the basis at n is the radiance of a white matte surface
  /// facing n (R. Ramamoorthi and P. Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
  /// SIGGRAPH 2001).
  const std::array<glm::vec3, 9>& irradiance() const { return irradiance_; }

  /// Mirror images for rough surfaces: level k is blurred as a surface of roughness k / (kLevels - 1) blurs (GGX seen
  /// head-on, B. Karis, SIGGRAPH 2013 course), and has half the size of level k - 1. RGBA rows from top to bottom.
  static constexpr int kLevels = 6;
  struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels;
  };
  const std::vector<Level>& levels() const { return levels_; }

  /// A direction chosen with a density along the luminance, and radiance / (pi density) there: what a white matte
  /// surface facing it would get if all light came from such directions. `square`: in the unit square.
  struct Sample {
    glm::vec3 towards{0, 1, 0};
    glm::vec3 part{0};
  };
  Sample sample(const glm::vec2& square) const;

  /// A bright spot (the sun of an outdoor picture) is taken out of the map and shines as a light of its own: smooth
  /// maps cannot hold it, and it throws the shadows.
  const std::optional<Light>& sun() const { return sun_; }

 private:
  void take_out_sun(std::vector<glm::vec3>& pixels, int width, int height);

  std::array<glm::vec3, 9> irradiance_{};
  std::vector<Level> levels_;
  std::optional<Light> sun_;
  int width_ = 0, height_ = 0;      ///< of the sampling grid
  std::vector<double> row_cdf_;     ///< height + 1
  std::vector<double> column_cdf_;  ///< height * (width + 1)
  std::vector<glm::vec3> grid_;
};

}  // namespace softreel::render
