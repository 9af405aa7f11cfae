#pragma once
// The only file that knows how a GL context without a display is made. Newer Mesa has no OSMesa: a surfaceless EGL
// context can stand in here, and nothing else changes.
#include <memory>

namespace softreel::render {

/// An OpenGL 4.5 core context, current on the thread that made it. Drawing goes to framebuffer objects: its own surface
/// is one pixel.
class GlContext {
 public:
  /// Throws RenderError (kContext).
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes it current on the calling thread again (another context may have been made meanwhile).
  void make_current();

  using Function = void (*)();
  /// Address of a GL function; null when the driver does not have it.
  static Function function(const char* name);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace softreel::render
