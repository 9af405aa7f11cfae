// Milliseconds per frame for a mesh of 131,072 triangles at 1280 x 720, and the whole program for one frame of it from
// an OBJ file. Prints medians; judges nothing.
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

void whole_program(int samples, int count) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "softreel_bench";
  std::filesystem::create_directories(folder);
  const std::filesystem::path obj = folder / "waves.obj";
  {
    const Shape plane = make_plane(2, 2, kCells);
    std::ofstream out(obj);
    for (const glm::vec3& p : waves(plane.positions, 0)) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (const glm::uvec3& t : plane.mesh.triangles)
      out << "f " << plane.mesh.position_of[t.x] + 1 << ' ' << plane.mesh.position_of[t.y] + 1 << ' '
          << plane.mesh.position_of[t.z] + 1 << '\n';
  }
  const std::string command = std::string(SOFTREEL_PROGRAM) + " turntable " + obj.string() +
                              " --count 1 -q --samples " + std::to_string(samples) + " -o " +
                              (folder / "frames").string();
  std::vector<double> runs;
  for (int i = 0; i < count; ++i)
    runs.push_back(seconds([&] {
      if (std::system(command.c_str()) != 0) std::printf("failed: %s\n", command.c_str());
    }));
  std::printf("whole program, one frame from OBJ, %2d samples: %7.1f ms\n", samples, 1e3 * median(runs));
  std::filesystem::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
  std::printf("131,072 moving triangles on a ground, 1280 x 720, medians of %d\n", count);
  for (const int samples : {1, 16})
    for (const bool shadow : {false, true}) frames(samples, shadow, count);
  whole_program(1, count);
  whole_program(16, count);
  return 0;
}
