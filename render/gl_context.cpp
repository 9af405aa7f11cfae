#include "render/gl_context.h"

// osmesa.h wants the old gl.h; its types are the same.
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <type_traits>

#include "render/error.h"

// OSMesa keeps its screen and a few words per context until the process ends: not for the leak checker of a sanitized
// build.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }

namespace softreel::render {

struct GlContext::State {
  OSMesaContext context = nullptr;
  std::array<unsigned char, 4> pixel{};
};

namespace {

/// The library is opened with the first context: it brings LLVM along, 40 ms of loading that a process which draws
/// nothing (a worker, a simulation, --help) need not wait for.
struct OsMesa {
  decltype(&OSMesaCreateContextAttribs) create_context;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaGetCurrentContext) current_context;
  decltype(&OSMesaGetProcAddress) function;
};

OsMesa open_osmesa() {
  constexpr const char* kLibrary = "libOSMesa.so.8";
  void* library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);  // until the process ends
  const auto why = [] {
    const char* text = dlerror();
    return text != nullptr ? text : "unknown error";
  };
  if (library == nullptr)
    throw RenderError(RenderErrorKind::kContext,
                      fmt::format("OSMesa cannot be loaded ({}): install libosmesa6", why()));
  OsMesa result{};
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    if (function == nullptr)
      throw RenderError(RenderErrorKind::kContext, fmt::format("{} has no {} ({})", kLibrary, name, why()));
  };
  find(result.create_context, "OSMesaCreateContextAttribs");
  find(result.destroy_context, "OSMesaDestroyContext");
  find(result.make_current, "OSMesaMakeCurrent");
  find(result.current_context, "OSMesaGetCurrentContext");
  find(result.function, "OSMesaGetProcAddress");
  return result;
}

const OsMesa& osmesa() {
  static const OsMesa library = open_osmesa();
  return library;
}

/// 512-bit vectors crash Mesa 22.3's code generator. Only our own process sees the change.
void avoid_wide_vectors() {
  static std::once_flag once;
  std::call_once(once, [] {
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    if (width != nullptr && std::atoi(width) > 256) setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  });
}

}  // namespace

GlContext::GlContext() : state_(std::make_unique<State>()) {
  avoid_wide_vectors();
  // 4.5: asked for 4.6, OSMesa returns null.
  constexpr std::array<int, 15> kAttributes{OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            OSMESA_STENCIL_BITS,
                                            0,
                                            OSMESA_ACCUM_BITS,
                                            0,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            4,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            5,
                                            0};
  state_->context = osmesa().create_context(kAttributes.data(), nullptr);
  if (state_->context == nullptr)
    throw RenderError(RenderErrorKind::kContext,
                      "OSMesa cannot make an OpenGL 4.5 core context (Mesa 22 or 23 is needed)");
  if (osmesa().make_current(state_->context, state_->pixel.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
    osmesa().destroy_context(state_->context);
    throw RenderError(RenderErrorKind::kContext, "OSMesa cannot make its OpenGL context current");
  }
}

GlContext::~GlContext() { osmesa().destroy_context(state_->context); }

void GlContext::make_current() {
  if (osmesa().current_context() == state_->context) return;
  if (osmesa().make_current(state_->context, state_->pixel.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE)
    throw RenderError(RenderErrorKind::kContext, "OSMesa cannot make its OpenGL context current");
}

GlContext::Function GlContext::function(const char* name) { return osmesa().function(name); }

}  // namespace softreel::render
