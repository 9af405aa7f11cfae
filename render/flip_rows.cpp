#include "render/flip_rows.h"

#include <algorithm>
#include <cmath>

namespace softreel::render {

namespace {

/// out[x] = sum over k of kernel(k) in[x + k]; `in` may be read `radius` values to both sides.
void along(const float* in, const HalfKernel& kernel, int width, float* __restrict out) {
  const float middle = kernel.weights[0];
  for (int x = 0; x < width; ++x) out[x] = middle * in[x];
  for (int k = 1; k <= kernel.radius(); ++k) {
    const float w = kernel.weights[static_cast<std::size_t>(k)];
    const float *left = in - k, *right = in + k;
    if (kernel.odd)
      for (int x = 0; x < width; ++x) out[x] += w * (right[x] - left[x]);
    else
      for (int x = 0; x < width; ++x) out[x] += w * (right[x] + left[x]);
  }
}

void length(const float* __restrict x, const float* __restrict y, int width, float* __restrict out) {
  for (int i = 0; i < width; ++i) out[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
}

}  // namespace

SeenRow::SeenRow(int width) {
  for (std::vector<float>* v : {&l, &a, &b, &edge, &point}) v->resize(static_cast<std::size_t>(width));
}

SeenRows::SeenRows(const Image& image, const FlipFilters& filters, int first_row)
    : image_(image), filters_(filters), row_(first_row), taken_(std::max(first_row - filters.radius, 0)) {
  const auto width = static_cast<std::size_t>(image.width), radius = static_cast<std::size_t>(filters.radius);
  ring_.resize(2 * radius + 1);
  for (FilteredRow& row : ring_)
    for (std::vector<float>& plane : row) plane.resize(width);
  for (std::vector<float>& channel : padded_) channel.resize(width + 2 * radius);
  for (std::vector<float>& row : scratch_) row.resize(width);
}

void SeenRows::take_in(int row) {
  const int radius = filters_.radius, width = image_.width;
  float* middle[3];
  for (std::size_t c = 0; c < 3; ++c) middle[c] = padded_[c].data() + radius;
  to_opponent(image_.pixel(0, row), width, {middle[0], middle[1], middle[2]});
  for (std::size_t c = 0; c < 3; ++c) {
    std::fill_n(padded_[c].begin(), radius, middle[c][0]);
    std::fill_n(middle[c] + width, radius, middle[c][width - 1]);
  }
  FilteredRow& out = ring_[static_cast<std::size_t>(row) % ring_.size()];
  along(middle[0], filters_.achromatic, width, out[kAchromatic].data());
  along(middle[1], filters_.red_green, width, out[kRedGreen].data());
  along(middle[2], filters_.blue_yellow_wide, width, out[kBlueYellowWide].data());
  along(middle[2], filters_.blue_yellow_narrow, width, out[kBlueYellowNarrow].data());
  along(middle[0], filters_.smooth, width, out[kSmooth].data());
  along(middle[0], filters_.edge, width, out[kEdge].data());
  along(middle[0], filters_.point, width, out[kPoint].data());
}

const float* SeenRows::filtered(Plane plane, int row) const {
  const int inside = std::clamp(row, 0, image_.height - 1);
  return ring_[static_cast<std::size_t>(inside) % ring_.size()][plane].data();
}

void SeenRows::down(Plane plane, const HalfKernel& kernel, float* __restrict out) const {
  const int width = image_.width;
  const float* middle = filtered(plane, row_);
  for (int x = 0; x < width; ++x) out[x] = kernel.weights[0] * middle[x];
  for (int k = 1; k <= kernel.radius(); ++k) {
    const float w = kernel.weights[static_cast<std::size_t>(k)];
    const float *above = filtered(plane, row_ - k), *below = filtered(plane, row_ + k);
    if (kernel.odd)
      for (int x = 0; x < width; ++x) out[x] += w * (below[x] - above[x]);
    else
      for (int x = 0; x < width; ++x) out[x] += w * (below[x] + above[x]);
  }
}

void SeenRows::next(SeenRow& out) {
  const int width = image_.width;
  for (const int last = std::min(row_ + filters_.radius, image_.height - 1); taken_ <= last; ++taken_) take_in(taken_);

  down(kAchromatic, filters_.achromatic, out.l.data());
  down(kRedGreen, filters_.red_green, out.a.data());
  down(kBlueYellowWide, filters_.blue_yellow_wide, out.b.data());
  down(kBlueYellowNarrow, filters_.blue_yellow_narrow, scratch_[0].data());
  const float wide = filters_.wide_part;
  for (std::size_t x = 0; x < out.b.size(); ++x) out.b[x] = wide * out.b[x] + (1 - wide) * scratch_[0][x];
  to_hunt_lab(width, {out.l.data(), out.a.data(), out.b.data()});

  down(kEdge, filters_.smooth, scratch_[0].data());
  down(kSmooth, filters_.edge, scratch_[1].data());
  length(scratch_[0].data(), scratch_[1].data(), width, out.edge.data());
  down(kPoint, filters_.smooth, scratch_[0].data());
  down(kSmooth, filters_.point, scratch_[1].data());
  length(scratch_[0].data(), scratch_[1].data(), width, out.point.data());
  ++row_;
}

}  // namespace softreel::render
