// FLIP against closed forms, and against a second implementation that follows the paper literally: dense
// two-dimensional filters in double precision, with the constants that the authors publish with their own code.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "render/flip.h"

using namespace softreel::render;

namespace {

using Vec = std::array<double, 3>;
using Plane = std::vector<double>;
constexpr double kPi = std::numbers::pi;

Image uniform(int r, int g, int b, int width = 40, int height = 30) {
  Image image = Image::blank(width, height);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    for (std::size_t c = 0; c < 4; ++c) image.rgba[4 * i + c] = static_cast<std::uint8_t>(std::array{r, g, b, 255}[c]);
  return image;
}

/// Waves, an edge and lone bright pixels in all channels.
Image pattern(int width, int height, double phase) {
  Image image = Image::blank(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double wave = std::sin(0.21 * x + phase) * std::cos(0.13 * y), step = x + y > width ? 60 : 0;
      const int dot = (x * 7 + y * 13 + static_cast<int>(10 * phase)) % 97 == 0 ? 120 : 0;
      const Vec color{70 + 60 * wave + step + dot, 90 + 50 * std::sin(0.4 * y + phase) + step, 100 - 80 * wave + dot};
      for (std::size_t c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = static_cast<std::uint8_t>(std::min(std::max(color[c], 0.0), 255.0));
      image.pixel(x, y)[3] = 255;
    }
  return image;
}

constexpr double kFromRgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                   {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                   {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double kToRgb[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                 {-0.969224334, 1.875930071, 0.041554224},
                                 {0.055639423, -0.204011202, 1.057148933}};
constexpr Vec kWhite{0.950428545, 1.0, 1.088900371};

Vec times(const double (&m)[3][3], const Vec& v) {
  Vec out{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) out[r] += m[r][c] * v[c];
  return out;
}

Vec opponent(const std::uint8_t* pixel) {
  Vec rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = pixel[c] / 255.0;
    rgb[c] = v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
  }
  const Vec xyz = times(kFromRgb, rgb);
  const double x = xyz[0] / kWhite[0], y = xyz[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Vec hunt_lab(const Vec& ycc) {
  const double y = (ycc[0] + 16) / 116, x = y + ycc[1] / 500, z = y - ycc[2] / 200;
  Vec rgb = times(kToRgb, {x * kWhite[0], y, z * kWhite[2]});
  for (double& v : rgb) v = std::min(std::max(v, 0.0), 1.0);
  const Vec xyz = times(kFromRgb, rgb);
  Vec f{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double t = xyz[c] / kWhite[c], delta = 6.0 / 29;
    f[c] = t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  }
  const double l = 116 * f[1] - 16;
  return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

double distance(const Vec& a, const Vec& b) {
  return std::abs(a[0] - b[0]) + std::sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

struct Dense {
  int radius;
  std::vector<double> weights;  ///< (2 radius + 1)^2, row by row
};

template <class Function>
Dense dense(int radius, Function&& f) {
  Dense kernel{radius, {}};
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x) kernel.weights.push_back(f(x, y));
  double positive = 0, negative = 0;
  for (const double w : kernel.weights) (w > 0 ? positive : negative) += w;
  for (double& w : kernel.weights) w /= w > 0 ? positive : -negative;
  return kernel;
}

Plane filtered(const Plane& in, int width, int height, const Dense& kernel) {
  Plane out(in.size());
  const int r = kernel.radius;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int j = -r; j <= r; ++j)
        for (int i = -r; i <= r; ++i) {
          const int xi = std::clamp(x + i, 0, width - 1), yj = std::clamp(y + j, 0, height - 1);
          sum += kernel.weights[static_cast<std::size_t>((j + r) * (2 * r + 1) + i + r)] *
                 in[static_cast<std::size_t>(yj * width + xi)];
        }
      out[static_cast<std::size_t>(y * width + x)] = sum;
    }
  return out;
}

struct Seen {
  std::vector<Vec> lab;
  Plane edge, point;
};

Seen seen(const Image& image, double ppd) {
  const int w = image.width, h = image.height;
  const std::size_t n = image.pixel_count();
  Plane channel[3] = {Plane(n), Plane(n), Plane(n)}, y(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec ycc = opponent(image.rgba.data() + 4 * i);
    for (std::size_t c = 0; c < 3; ++c) channel[c][i] = ycc[c];
    y[i] = (ycc[0] + 16) / 116;
  }
  const double terms[3][4] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
  for (std::size_t c = 0; c < 3; ++c) {
    const double* t = terms[c];
    channel[c] = filtered(channel[c], w, h, dense(radius, [&](int dx, int dy) {
                            const double d2 = (dx * dx + dy * dy) / (ppd * ppd);
                            return t[0] * std::sqrt(kPi / t[1]) * std::exp(-kPi * kPi * d2 / t[1]) +
                                   t[2] * std::sqrt(kPi / t[3]) * std::exp(-kPi * kPi * d2 / t[3]);
                          }));
  }
  Seen s;
  for (std::size_t i = 0; i < n; ++i) s.lab.push_back(hunt_lab({channel[0][i], channel[1][i], channel[2][i]}));
  const double sigma = 0.5 * 0.082 * ppd;
  const int feature_radius = static_cast<int>(std::ceil(3 * sigma));
  const auto bell = [&](int dx, int dy) { return std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma)); };
  const auto features = [&](auto&& along) {
    const Plane fx = filtered(y, w, h, dense(feature_radius, [&](int a, int b) { return along(a) * bell(a, b); }));
    const Plane fy = filtered(y, w, h, dense(feature_radius, [&](int a, int b) { return along(b) * bell(a, b); }));
    Plane length(n);
    for (std::size_t i = 0; i < n; ++i) length[i] = std::hypot(fx[i], fy[i]);
    return length;
  };
  s.edge = features([](int d) { return static_cast<double>(-d); });
  s.point = features([&](int d) { return d * d / (sigma * sigma) - 1; });
  return s;
}

Plane literal_flip(const Image& reference, const Image& test, double ppd) {
  const Seen r = seen(reference, ppd), t = seen(test, ppd);
  const std::uint8_t green[3] = {0, 255, 0}, blue[3] = {0, 0, 255};
  const double largest = std::pow(distance(hunt_lab(opponent(green)), hunt_lab(opponent(blue))), 0.7);
  Plane map;
  for (std::size_t i = 0; i < r.lab.size(); ++i) {
    const double error = std::pow(distance(r.lab[i], t.lab[i]), 0.7), knee = 0.4 * largest;
    const double color = error < knee ? 0.95 / knee * error : 0.95 + (error - knee) / (largest - knee) * 0.05;
    const double feature =
        std::sqrt(std::max(std::abs(r.edge[i] - t.edge[i]), std::abs(r.point[i] - t.point[i])) / std::numbers::sqrt2);
    map.push_back(std::pow(color, 1 - feature));
  }
  return map;
}

void check_against_literal(const Image& a, const Image& b, double ppd) {
  const FlipMap map = flip(a, b, {ppd});
  const Plane expected = literal_flip(a, b, ppd);
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    worst = std::max(worst, std::abs(expected[i] - static_cast<double>(map.error[i])));
    mean += expected[i] / static_cast<double>(expected.size());
  }
  INFO(ppd << " pixels per degree, mean " << mean);
  // Single precision: L* is a difference of about 100 known to 1e-5, and d^0.7 has a slope of 1 near d = 0.3.
  CHECK(worst < 1e-4);
  CHECK(map.mean == doctest::Approx(mean).epsilon(1e-5));
}

}  // namespace

TEST_CASE("FLIP of uniform pictures is what follows from the paper by hand") {
  CHECK(flip(uniform(9, 80, 200), uniform(9, 80, 200)).max == 0);
  // Pure green against pure blue is the largest colour difference by definition.
  CHECK(flip(uniform(0, 255, 0), uniform(0, 0, 255)).mean == doctest::Approx(1).epsilon(1e-6));
  // Black against white: HyAB is 100; the largest difference to the power 0.7 is 41.2760.
  const double black_white = std::pow(100, 0.7), largest = 41.2760, knee = 0.4 * largest;
  CHECK(flip(uniform(0, 0, 0), uniform(255, 255, 255)).mean ==
        doctest::Approx(0.95 + 0.05 * (black_white - knee) / (largest - knee)).epsilon(1e-5));
  // Two dark greys below the linear end of CIELab: L* = 903.3 Y.
  const double difference = 24389.0 / 27 * (10 - 5) / 255 / 12.92;
  CHECK(flip(uniform(5, 5, 5), uniform(10, 10, 10)).mean ==
        doctest::Approx(0.95 * std::pow(difference, 0.7) / knee).epsilon(1e-4));
}

TEST_CASE("FLIP agrees with a literal implementation of the paper in every pixel, at several distances") {
  const Image a = pattern(61, 43, 0), b = pattern(61, 43, 0.6);
  for (const double ppd : {20.0, 67.0206432766, 90.0}) check_against_literal(a, b, ppd);
  check_against_literal(a, uniform(128, 128, 128, 61, 43), 67.0206432766);
  check_against_literal(pattern(3, 2, 0), pattern(3, 2, 1), 67.0206432766);  // smaller than every filter
}

TEST_CASE("The default view of FLIP is the one of the paper") {
  CHECK(FlipView{}.pixels_per_degree == doctest::Approx(pixels_per_degree(0.7, 0.7, 3840)).epsilon(1e-12));
}

TEST_CASE("FLIP has the same bits for any number of threads, and names its worst pixel") {
  const Image a = pattern(130, 301, 0);
  Image b = a;
  b.pixel(77, 200)[1] = 255;
  const FlipMap one = flip(a, b);
  for (const int threads : {2, 3, 8}) {
    const FlipMap many = flip(a, b, {}, threads);
    CHECK(many.error == one.error);
    CHECK(many.mean == one.mean);
  }
  CHECK(std::abs(one.max_x - 77) <= 3);
  CHECK(std::abs(one.max_y - 200) <= 3);
  CHECK(one.error[0] == 0);  // far from what changed
  CHECK_THROWS_AS(flip(a, uniform(0, 0, 0)), std::invalid_argument);
}
