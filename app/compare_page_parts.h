#pragma once
// What is the same in every page of a comparison. The script reads `frames` (figures), `order` (indices, worst first)
// and `pictures` (index -> reference, actual, difference as data: URIs, and the texts inside of the PNGs).

namespace softreel::app {

extern const char* const kComparePageStyle;
extern const char* const kComparePageBody;
extern const char* const kComparePageScript;

}  // namespace softreel::app
