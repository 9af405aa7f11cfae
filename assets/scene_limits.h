#pragma once
// Bounds on what a scene may ask for, checked before any memory is asked for.
#include "assets/scene_table.h"

namespace softreel::assets {

constexpr double kMostFrames = 1e6;
constexpr double kMostSteps = 1e9;
constexpr double kMostTriangles = 8e6;          ///< of one cloth: some gigabytes of matrix
constexpr double kMostTets = 8e6;               ///< of one soft body
constexpr double kMostPoints = 1e6;             ///< of one body of springs
constexpr int kTetsPerCell = 6;                 ///< at most, when a block is cut up
constexpr double kMostPixels = 1 << 26;         ///< 16 bytes each while a frame is averaged: a gigabyte
constexpr size_t kLargestSceneFile = 16 << 20;  ///< [bytes]

constexpr Range at_least(double lo, double hi = 1e12) { return {lo, hi}; }
constexpr Range above(double lo, double hi = 1e12, const char* why_hi = "") {
  return {lo, hi, true, false, "", why_hi};
}
constexpr Range between(double lo, double hi, const char* why_lo = "", const char* why_hi = "") {
  return {lo, hi, false, false, why_lo, why_hi};
}

constexpr const char* kFar = "pictures are drawn in single precision";

constexpr Range kUnit = between(0, 1);
constexpr Range kPlace = between(-1e6, 1e6, kFar, kFar);  // [m]
constexpr Range kLength = above(0, 1e6, kFar);            // [m]
constexpr Range kAngle = between(-1e6, 1e6);              // [deg]
constexpr Range kSpeed = between(-1e5, 1e5);              // [m/s]
constexpr Range kTurns = between(-1e6, 1e6);              // [deg/s]
constexpr Range kFps = between(0.01, 1e5);
constexpr Range kDuration = above(0, 1e6);  // [s]
constexpr Range kSubsteps = between(1, 1e6);
constexpr Range kTolerance = Range{1e-12, 1, false, true, "less is lost in rounding"};
constexpr Range kRelaxation = Range{0, 2, true, true, "outside sor converges for no matrix"};
constexpr Range kCells = between(1, 4096);
constexpr Range kYoung = above(0, 1e13, "diamond has 1e12");  // [Pa]
constexpr Range kPoisson = Range{0, 0.5, false, true, "", "0.5 would be incompressible"};
constexpr Range kDensity = above(0, 1e5, "osmium has 22600");  // [kg/m^3]
constexpr Range kStiffness = above(0, 1e15);
constexpr Range kPixels = between(1, 8192, "", "the renderer has no larger pictures");
constexpr Range kSamples = between(1, 4096);

}  // namespace softreel::assets
