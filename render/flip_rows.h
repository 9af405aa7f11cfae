#pragma once
// What FLIP looks at in one picture, row by row: colours as they are seen from afar, edges and points. Only as many
// rows are kept as the filters reach.
#include <array>
#include <vector>

#include "render/flip_color.h"
#include "render/flip_filters.h"
#include "render/image.h"

namespace softreel::render {

/// One row: Hunt-adjusted CIELab after the contrast sensitivity, and the lengths of the two feature vectors.
struct SeenRow {
  explicit SeenRow(int width);
  std::vector<float> l, a, b, edge, point;
};

class SeenRows {
 public:
  /// Starts in front of `first_row`. `image` and `filters` must outlive this.
  SeenRows(const Image& image, const FlipFilters& filters, int first_row);
  void next(SeenRow& out);

 private:
  /// What is left of a row when it is filtered along x: each colour channel, and luminance three ways.
  enum Plane { kAchromatic, kRedGreen, kBlueYellowWide, kBlueYellowNarrow, kSmooth, kEdge, kPoint, kPlanes };
  using FilteredRow = std::array<std::vector<float>, kPlanes>;

  void take_in(int row);
  const float* filtered(Plane plane, int row) const;
  /// The column filter over the rows around `row_`.
  void down(Plane plane, const HalfKernel& kernel, float* out) const;

  const Image& image_;
  const FlipFilters& filters_;
  int row_, taken_;  // next row to give; first row that is not taken in
  std::vector<FilteredRow> ring_;
  std::array<std::vector<float>, 3> padded_;  // one row of luminance, Cx, Cz with its ends repeated
  std::vector<float> scratch_[2];
};

}  // namespace softreel::render
