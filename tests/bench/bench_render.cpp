// Milliseconds per frame for a mesh of 131,072 triangles at 1280 x 720, the whole program for one frame and for a
// turntable of it from an OBJ file, start-up, and what a frame costs against triangles, pixels and samples. Prints
// medians (of the turntable with 16 samples one run); judges nothing. A few minutes on two cores.
//
//   build/release/tests/bench_render [FRAMES]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "render/png.h"
#include "render/renderer.h"

using namespace softreel::render;

namespace {

constexpr int kCells = 256;  // 131,072 triangles

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<glm::vec3> waves(const std::vector<glm::vec3>& rest, double t) {
  std::vector<glm::vec3> x = rest;
  for (glm::vec3& p : x) p.y = 0.08f * static_cast<float>(std::sin(9 * p.x + 3 * t) * std::cos(7 * p.z - 2 * t));
  return x;
}

void frames(int samples, bool shadow, int count) {
  Renderer renderer({1280, 720, samples, 0, 0});
  const Shape plane = make_plane(2, 2, kCells);
  Look look;
  look.two_sided = true;
  const MeshId mesh = renderer.add_mesh(plane.mesh, {look});
  Bounds bounds;
  bounds.add(waves(plane.positions, 0));
  const Camera camera = frame_bounds(bounds, 35, 1280.0f / 720.0f);
  Stage stage = default_stage(bounds, camera, true, -0.5f);
  for (Light& light : stage.lights) light.casts_shadow = shadow;
  std::vector<double> draw, encode;
  for (int f = 0; f <= count; ++f) {
    renderer.set_positions(mesh, waves(plane.positions, f / 30.0));
    Image image;
    const double s = seconds([&] { image = renderer.render(camera, stage.lights, stage.environment); });
    if (f == 0) {
      std::printf("%3d samples, %-10s first frame %7.1f ms", samples, shadow ? "shadow" : "no shadow", 1e3 * s);
      continue;
    }
    draw.push_back(s);
    encode.push_back(seconds([&] { encode_png(image); }));
  }
  std::printf(", then %7.1f ms; encoding %5.1f ms\n", 1e3 * median(draw), 1e3 * median(encode));
  std::fflush(stdout);
}

/// Cost of a frame that moves, and of drawing the same frame again without new positions and tone curve: the share of
/// the raw draw.
void cost(const char* what, int cells, int width, int height, int samples, int count) {
  Renderer renderer({width, height, samples, 0, 0});
  const Shape plane = make_plane(2, 2, cells);
  Look look;
  look.two_sided = true;
  const MeshId mesh = renderer.add_mesh(plane.mesh, {look});
  Bounds bounds;
  bounds.add(waves(plane.positions, 0));
  const Camera camera = frame_bounds(bounds, 35, static_cast<float>(width) / static_cast<float>(height));
  const Stage stage = default_stage(bounds, camera, true, -0.5f);
  std::vector<double> frame, draw;
  for (int f = 0; f <= count; ++f) {
    const std::vector<glm::vec3> positions = waves(plane.positions, f / 30.0);
    const double whole = seconds([&] {
      renderer.set_positions(mesh, positions);
      renderer.render(camera, stage.lights, stage.environment);
    });
    const double raw = seconds([&] { renderer.render_linear(camera, stage.lights, stage.environment); });
    if (f == 0) continue;
    frame.push_back(whole);
    draw.push_back(raw);
  }
  std::printf("%-10s %7d triangles %4d x %4d %3d samples: %8.1f ms, of which drawing %8.1f ms (%3.0f %%)\n", what,
              2 * cells * cells, width, height, samples, 1e3 * median(frame), 1e3 * median(draw),
              100 * median(draw) / median(frame));
  std::fflush(stdout);
}

void write_obj(const std::filesystem::path& file, int cells) {
  const Shape plane = make_plane(2, 2, cells);
  std::ofstream out(file);
  for (const glm::vec3& p : waves(plane.positions, 0)) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const glm::uvec3& t : plane.mesh.triangles)
    out << "f " << plane.mesh.position_of[t.x] + 1 << ' ' << plane.mesh.position_of[t.y] + 1 << ' '
        << plane.mesh.position_of[t.z] + 1 << '\n';
}

/// The program from its start to its end, for a turntable of a mesh of `cells` x `cells` squares.
void whole_program(const char* what, int cells, const std::string& options, int count) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "softreel_bench";
  std::filesystem::create_directories(folder);
  const std::filesystem::path obj = folder / "waves.obj";
  write_obj(obj, cells);
  const std::string command = std::string(SOFTREEL_PROGRAM) + " turntable " + obj.string() + " -q " + options + " -o " +
                              (folder / "frames").string();
  std::vector<double> runs;
  for (int i = 0; i < count; ++i)
    runs.push_back(seconds([&] {
      if (std::system(command.c_str()) != 0) std::printf("failed: %s\n", command.c_str());
    }));
  std::printf("whole program, %-40s %8.1f ms\n", what, 1e3 * median(runs));
  std::fflush(stdout);
  std::filesystem::remove_all(folder);
}

void start_up(int count) {
  std::vector<double> runs;
  for (int i = 0; i < count; ++i) runs.push_back(seconds([] { const Renderer renderer({16, 16, 1, 0, 0}); }));
  std::printf("a renderer from nothing to its first GL calls            %8.1f ms\n", 1e3 * median(runs));
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  std::printf("131,072 moving triangles on a ground, 1280 x 720, medians of %d\n", count);
  for (const int samples : {1, 16})
    for (const bool shadow : {false, true}) frames(samples, shadow, samples > 1 ? std::min(count, 3) : count);
  start_up(count);
  whole_program("2 triangles, 16 x 16, one picture", 1, "--count 1 --samples 1 --size 16 16", count);
  whole_program("one picture from OBJ, 1 sample", kCells, "--count 1 --samples 1", count);
  const int few = std::min(count, 3);
  whole_program("one picture from OBJ, 16 samples", kCells, "--count 1 --samples 16", few);
  whole_program("turntable of 36 pictures, 1 sample", kCells, "--count 36 --samples 1", few);
  whole_program("turntable of 36 pictures, 16 samples", kCells, "--count 36 --samples 16", 1);
  for (const int cells : {32, 64, 128, 256, 512}) cost("triangles", cells, 1280, 720, 1, few);
  for (const int width : {320, 640, 1280, 1920}) cost("pixels", kCells, width, width * 9 / 16, 1, few);
  for (const int samples : {1, 4, 16, 64}) cost("samples", kCells, 1280, 720, samples, few);
  return 0;
}
