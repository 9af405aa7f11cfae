#pragma once
// How far a picture of N passes is from one of infinitely many, as far as its own halves can tell.
#include "render/environment.h"
#include "render/film.h"

namespace softreel::render {

/// RMS distance of two pictures of the same size as they would be shown (exposure, tone curve, sRGB), in levels of 255.
/// Looks at every pixel of small pictures, at about 100,000 evenly spread ones of large ones.
double shown_difference(const FloatImage& a, const FloatImage& b, const Environment& environment);

/// Estimated error of the mean of two halves, `first` and `second` (means of as many passes each). Were they
/// independent, their mean would be off by half of their difference (RMS). The halves of a stratified sequence make up
/// for one another, so the error is smaller than that: the estimate is on the safe side.
double halves_error(const FloatImage& first, const FloatImage& second, const Environment& environment);

}  // namespace softreel::render
