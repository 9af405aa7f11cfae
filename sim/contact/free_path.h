#pragma once
// Additive continuous collision detection (Li, Kaufman, Jiang 2021, "Codimensional incremental potential contact",
// section 5).
#include "sim/contact/closest_points.h"

namespace softreel::sim {

/// How much of its gap a pair keeps at least on one path.
inline constexpr double kKeptGap = 0.1;

/// A lower bound, in [0, 1], of how far a pair can go along x + s p before its gap (distance - offset) falls below
/// kKeptGap of what it is at x. Stops looking at `enough`: an answer >= enough says that much and no more.
/// 0 where the gap is not positive or lost in rounding.
///
/// Why it never lets a pair through: with p taken relative to the mean of the four, no distance between a point of the
/// first feature and one of the second changes faster than l = max |p_first| + max |p_second|. From a gap g' the pair
/// can therefore go (g' - kKeptGap g)/l without falling below kKeptGap g. The path is made of such pieces, each
/// measured at its own start, so at no time in between the gap is smaller. Ending early only makes the answer smaller.
double free_path(PairKind kind, const FourPoints& x, const FourPoints& p, double offset, double enough = 1);

}  // namespace softreel::sim
