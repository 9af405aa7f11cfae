#pragma once
// What a pass is drawn into, and the sum of the passes.
#include <memory>

#include "render/counters.h"
#include "render/film.h"
#include "render/gl_objects.h"

namespace softreel::render {

class FilmTarget {
 public:
  FilmTarget(const GlFunctions& gl, int width, int height);

  /// Binds and clears the target of one pass: nothing drawn, alpha 0.
  void begin_pass();
  /// Adds what was drawn to the sum. Not called for a picture of one pass: the accumulation buffer is made with the
  /// first call. `first`: begins a new sum.
  void accumulate(bool first, RenderCounters& counters);
  /// The mean of the passes, or the one pass when there was only one.
  FloatImage read(int passes);

 private:
  struct Accumulation {
    GlTexture sum;
    GlFramebuffer framebuffer;
    GlProgram copy;
    GlVertexArray no_vertices;
  };
  void make_accumulation();

  const GlFunctions& gl_;
  int width_;
  int height_;
  GlTexture color_;
  GlTexture depth_;
  GlFramebuffer framebuffer_;
  std::unique_ptr<Accumulation> accumulation_;
};

}  // namespace softreel::render
