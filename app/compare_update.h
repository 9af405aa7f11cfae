#pragma once
// What becomes of references: accepted anew, or missing.
#include "app/compare_outputs.h"

namespace softreel::app {

/// Says what changes, then makes every actual picture that is not good the reference (references without an actual one
/// are removed from nothing: they are told and stay). The number of files written. Throws UserError (kInput, kOutput).
int update_references(const Comparison& comparison, const std::string& reference);

/// Where a picture lies that has no reference yet: beside the place of the reference, as NAME.actual.EXT.
std::filesystem::path beside(const std::filesystem::path& reference);

/// Copies `actual` to that place, which is told. Throws UserError.
void leave_beside(const std::filesystem::path& reference, const std::filesystem::path& actual);

}  // namespace softreel::app
