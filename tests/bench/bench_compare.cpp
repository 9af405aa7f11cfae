// Milliseconds for two pictures of 1920 x 1080, decoding included, by each rung; and time and memory for a folder of
// 240 of them. Prints medians; judges nothing.
//
//   build/release/tests/bench_compare [REFERENCE.png ACTUAL.png]
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "render/compare_images.h"
#include "render/flip.h"
#include "render/image_io.h"
#include "render/png.h"

using namespace softreel::render;
namespace fs = std::filesystem;

namespace {

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_of(int count, const std::function<void()>& work) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(milliseconds(work));
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Smooth shading, edges and a little noise, as a rendered frame has them; `seed` of the noise.
Image frame(unsigned seed) {
  Image image = Image::blank(1920, 1080);
  unsigned state = seed;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      state = state * 1664525u + 1013904223u;
      const bool body = std::hypot(x - 900, y - 500) < 350;
      const int noise = body && state >> 30 == 0 ? 1 : 0;
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>((body ? 60 + x / 20 : 180 + y / 30) + noise);
      p[1] = static_cast<std::uint8_t>((body ? 90 + y / 20 : 190 + y / 30) + noise);
      p[2] = static_cast<std::uint8_t>((body ? 140 : 200 + y / 40) + noise);
      p[3] = 255;
    }
  return image;
}

/// Runs the program; its seconds and peak memory [MiB].
void run(const std::vector<std::string>& arguments, const char* what) {
  std::fflush(stdout);  // or the child would print it again
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    std::freopen("/dev/null", "w", stdout);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%-44s %7.2f s, %5.1f ms a frame, peak memory %ld MiB, exit code %d\n", what, seconds,
              seconds / 240 * 1e3, usage.ru_maxrss / 1024, WEXITSTATUS(status));
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path folder = fs::temp_directory_path() / ("softreel-bench-compare-" + std::to_string(getpid()));
  const fs::path reference = folder / "reference", actual = folder / "actual";
  fs::create_directories(reference);
  fs::create_directories(actual);
  const fs::path a = reference / "frame_0001.png", b = actual / "frame_0001.png";
  if (argc == 3) {
    fs::copy_file(argv[1], a);
    fs::copy_file(argv[2], b);
  } else {
    write_png(a, frame(1));
    write_png(b, frame(2));
  }
  Image x, y;
  const double decode = median_of(9, [&] {
    auto other = std::async(std::launch::async, [&] { y = load_image(b); });
    x = load_image(a);
    other.get();
  });
  const double figures = median_of(9, [&] { compare(x, y); });
  const double one = median_of(5, [&] { flip(x, y, {}, 1); }), two = median_of(5, [&] { flip(x, y, {}, 2); });
  std::printf(
      "two pictures of %d x %d, two threads [ms]: decode both %.1f, figures %.1f; FLIP %.1f (one thread %.1f)\n",
      x.width, x.height, decode, figures, two, one);
  std::printf("driver: %.1f ms; with FLIP: %.1f ms\n", decode + figures, decode + figures + two);
  for (int i = 2; i <= 240; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04d.png", i);
    fs::create_hard_link(a, reference / name);
    fs::create_hard_link(b, actual / name);
  }
  run({SOFTREEL_PROGRAM, "compare", reference.string(), actual.string(), "--quiet"}, "240 frames, driver");
  run({SOFTREEL_PROGRAM, "compare", reference.string(), actual.string(), "--quiet", "--tolerance", "perceptual"},
      "240 frames, perceptual");
  fs::remove_all(folder);
}
