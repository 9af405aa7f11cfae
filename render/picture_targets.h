#pragma once
// What a pass is drawn into. First the nearest surface of every pixel is noted down (geometry), then every pixel is lit
// once (film): with triangles smaller than a few pixels, llvmpipe would otherwise light each pixel many times over, as
// it shades blocks of 4 x 4.
#include <glm/glm.hpp>
#include <vector>

#include "render/counters.h"
#include "render/film.h"
#include "render/gl_objects.h"

namespace softreel::render {

class PictureTargets {
 public:
  PictureTargets(const GlFunctions& gl, int width, int height);

  /// From now on the film has a second layer, FloatImage::display.
  void add_display();
  /// From now on the geometry target has a second layer, for what surfaces give off.
  void add_emission();
  /// Binds the geometry target and clears it: nothing there.
  void begin_geometry();
  /// Binds the film and what `begin_geometry` has noted as textures. With several passes the film is an accumulation
  /// buffer: every pass is added to it, in order, so that the sum has the same bits every time. `pass`: 0 begins a new
  /// sum.
  void begin_lighting(int pass, int passes, RenderCounters& counters);
  /// The sum of the passes so far times `weight`.
  FloatImage read(float weight);
  /// What `begin_geometry` and the drawing after it have noted: words, and depths 0..1, rows from top to bottom.
  void read_geometry(std::vector<glm::uvec4>& words, std::vector<float>& depth);

 private:
  const GlFunctions& gl_;
  int width_;
  int height_;
  bool summed_ = false;
  GlTexture surface_;  ///< four packed words per pixel, see shader_geometry.cpp
  GlTexture depth_;
  GlTexture emission_;
  GlFramebuffer geometry_;
  GlTexture color_;
  GlTexture display_;
  GlFramebuffer film_;
  GlSampler nearest_;
};

}  // namespace softreel::render
