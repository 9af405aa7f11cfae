#pragma once
// Table of the OpenGL functions that the renderer calls. Filled by hand: linking libGL beside OSMesa makes calls return
// null.
#include <GL/glcorearb.h>

namespace softreel::render {

// One line per function: its type in glcorearb.h, its name without "gl".
#define SOFTREEL_GL_FUNCTIONS(X)                                         \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                 \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                             \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                           \
  X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                           \
  X(PFNGLBINDSAMPLERPROC, BindSampler)                                   \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                           \
  X(PFNGLBLENDFUNCPROC, BlendFunc)                                       \
  X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)   \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)           \
  X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)         \
  X(PFNGLCOLORMASKPROC, ColorMask)                                       \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                               \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                               \
  X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                     \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                               \
  X(PFNGLCREATESAMPLERSPROC, CreateSamplers)                             \
  X(PFNGLCREATESHADERPROC, CreateShader)                                 \
  X(PFNGLCREATETEXTURESPROC, CreateTextures)                             \
  X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                     \
  X(PFNGLCULLFACEPROC, CullFace)                                         \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                               \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                     \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                               \
  X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                             \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                 \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                             \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                     \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                       \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                       \
  X(PFNGLDISABLEPROC, Disable)                                           \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                     \
  X(PFNGLDRAWELEMENTSPROC, DrawElements)                                 \
  X(PFNGLENABLEPROC, Enable)                                             \
  X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)           \
  X(PFNGLFRONTFACEPROC, FrontFace)                                       \
  X(PFNGLGENERATETEXTUREMIPMAPPROC, GenerateTextureMipmap)               \
  X(PFNGLGETERRORPROC, GetError)                                         \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                   \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                       \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                 \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                         \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                   \
  X(PFNGLGETSTRINGPROC, GetString)                                       \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                   \
  X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                     \
  X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                     \
  X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC, NamedFramebufferDrawBuffer)     \
  X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers)   \
  X(PFNGLNAMEDFRAMEBUFFERREADBUFFERPROC, NamedFramebufferReadBuffer)     \
  X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)           \
  X(PFNGLNAMEDFRAMEBUFFERTEXTURELAYERPROC, NamedFramebufferTextureLayer) \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                   \
  X(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                         \
  X(PFNGLPROGRAMUNIFORM3FVPROC, ProgramUniform3fv)                       \
  X(PFNGLPROGRAMUNIFORM4FVPROC, ProgramUniform4fv)                       \
  X(PFNGLPOLYGONMODEPROC, PolygonMode)                                   \
  X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                               \
  X(PFNGLPROGRAMUNIFORMMATRIX3FVPROC, ProgramUniformMatrix3fv)           \
  X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)           \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                     \
  X(PFNGLSAMPLERPARAMETERFPROC, SamplerParameterf)                       \
  X(PFNGLSAMPLERPARAMETERFVPROC, SamplerParameterfv)                     \
  X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)                       \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                 \
  X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                         \
  X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                         \
  X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                       \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                     \
  X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)         \
  X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)           \
  X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)         \
  X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)           \
  X(PFNGLVIEWPORTPROC, Viewport)

struct GlFunctions {
#define SOFTREEL_GL_MEMBER(type, name) type name = nullptr;
  SOFTREEL_GL_FUNCTIONS(SOFTREEL_GL_MEMBER)
#undef SOFTREEL_GL_MEMBER
};

/// All functions, from the current context. Throws RenderError (kContext) naming the first that is missing.
GlFunctions load_gl_functions();

/// Throws RenderError (kContext) with `what` when an earlier call left a GL error behind.
void check_gl(const GlFunctions& gl, const char* what);

}  // namespace softreel::render
