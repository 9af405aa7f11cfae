#include "assets/surface_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "assets/child_process.h"
#include "assets/error.h"
#include "assets/raw_surface.h"

namespace softreel::assets {
namespace {

// Formats of assimp that carry meshes and that the tests feed with broken files.
constexpr const char* kExtensions[] = {"obj", "ply", "stl", "off", "gltf", "glb",
                                       "fbx", "dae", "3ds", "3mf", "x",    "x3d"};

std::string extension(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  if (!text.empty()) text.erase(0, 1);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::uintmax_t checked_size(const std::filesystem::path& file, const ImportLimits& limits) {
  const auto refuse = [&](const std::string& why) { throw UserError(ErrorKind::kInput, file.string(), why); };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  if (std::filesystem::is_directory(status)) refuse("is a folder; name a mesh file");
  if (!std::filesystem::is_regular_file(status)) refuse("is no regular file");
  if (!is_surface_file(file)) {
    refuse(fmt::format("'.{}' is no surface format that is read here; these are: {}", extension(file),
                       surface_extensions()));
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) refuse(fmt::format("cannot be read: {}", error.message()));
  if (size == 0) refuse("is empty; export the mesh again");
  if (size > limits.file_bytes) refuse(fmt::format("has {} bytes; at most {} are read", size, limits.file_bytes));
  return size;
}

}  // namespace

bool is_surface_file(const std::filesystem::path& file) {
  const std::string ext = extension(file);
  return std::find(std::begin(kExtensions), std::end(kExtensions), ext) != std::end(kExtensions);
}

const std::string& surface_extensions() {
  static const std::string list = fmt::format("{}", fmt::join(kExtensions, ", "));
  return list;
}

ImportedSurface import_surface(const std::filesystem::path& file, const MeshOptions& options,
                               const ImportLimits& limits) {
  const std::uintmax_t size = checked_size(file, limits);
  std::error_code ignored;
  BlobWriter request;
  request.text(std::filesystem::absolute(file, ignored).string());
  request.value<std::uint64_t>(limits.triangles);
  ChildLimits child;
  child.seconds = limits.seconds;
  // assimp needs some 30 times the size of a text file; a broken count in a small file must not take the machine.
  child.memory_bytes = std::max<std::size_t>(std::size_t{3} << 30, 64 * static_cast<std::size_t>(size));
  child.poll = limits.poll;
  const ChildResult result = run_worker("import", request.bytes, child);
  if (result.end != ChildResult::End::kDone) {
    throw UserError(ErrorKind::kInput, file.string(),
                    fmt::format("cannot be imported: assimp {}; the file is probably broken, export it again",
                                result.how_it_ended(limits.seconds)));
  }
  RawSurface raw;
  try {
    raw = read_raw(result.output);
  } catch (const BrokenBlob&) {
    raw.error = "cannot be imported: assimp's answer is broken; export the file again";
  }
  if (!raw.error.empty()) throw UserError(ErrorKind::kInput, file.string(), raw.error);
  return build_surface(std::move(raw), file.string(), options);
}

}  // namespace softreel::assets
