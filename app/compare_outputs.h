#pragma once
// A comparison, written down for people, scripts and continuous integration.
#include <string>
#include <vector>

#include "app/compare_clip.h"

namespace softreel::app {

struct Comparison {
  std::string reference, actual;  ///< as they were named
  std::string command;            ///< as it was typed
  std::vector<FramePair> pairs;
  CompareRules rules;
  ClipResult clip;  ///< one frame for each pair
};

/// Closing lines: worst, first, flicker, shift, frames in each other's place, how many differ.
std::string closing_lines(const Comparison& comparison);

/// Every figure. See the README for the keys.
std::string compare_json(const Comparison& comparison);

/// JUnit XML: a test case for each frame, a failure says what the terminal says.
std::string compare_junit(const Comparison& comparison);

/// One HTML page with all it needs inside; pictures of at most `pictures` frames, the worst first, read one by one.
/// Throws UserError (kOutput), RenderError (kInput).
void write_compare_page(const std::string& file, const Comparison& comparison, int pictures);

/// "reference: FILE", "versions differ: ..." - what the texts inside of two PNGs say that is not the same; empty for
/// equal texts. Key, reference, actual.
struct TextDifference {
  std::string key, reference, actual;
  bool same() const { return reference == actual; }
};
std::vector<TextDifference> picture_texts(const FramePair& pair);

}  // namespace softreel::app
