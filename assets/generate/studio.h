#pragma once
// A photographer's studio as light from all directions.
#include <filesystem>

namespace softreel::generate {

/// Writes a Radiance .hdr file (128 x 64, equirectangular, middle column towards -z): a large warm soft box to the
/// upper left in front, a cool one to the right, a strip behind, grey walls and floor.
void write_studio(const std::filesystem::path& file);

}  // namespace softreel::generate
