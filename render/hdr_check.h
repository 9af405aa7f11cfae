#pragma once
// Is a Radiance picture (.hdr) whole? stb_image reads zeros beyond the end of a file, and a run of length zero does not
// bring it any further: it would go on for ever.
#include <cstddef>
#include <span>
#include <string>

namespace softreel::render {

/// What is wrong with the pixels, for the user; empty: nothing, or it is no such picture. Runs as in Ward 1991, "Real
/// pixels", and the reader of Radiance (new run-length encoding).
std::string hdr_damage(std::span<const std::byte> bytes);

}  // namespace softreel::render
