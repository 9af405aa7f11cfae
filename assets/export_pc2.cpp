#include "assets/export_pc2.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <stdexcept>

namespace softreel::assets {

Pc2Writer::Pc2Writer(const std::filesystem::path& file, int points, int frames, float start, float step)
    : file_(file), points_(points), frames_(frames) {
  file_.write("POINTCACHE2", 12);  // with its closing zero
  for (const std::int32_t v : {std::int32_t{1}, std::int32_t{points}}) file_.write(&v, sizeof v);
  file_.write(&start, sizeof start);
  file_.write(&step, sizeof step);
  const std::int32_t samples = frames;
  file_.write(&samples, sizeof samples);
}

void Pc2Writer::add(std::span<const sim::Vec3> vertices) {
  if (static_cast<int>(vertices.size()) != points_ || added_ >= frames_) {
    throw std::logic_error("Pc2Writer: not the promised number of points or frames");
  }
  for (const sim::Vec3& p : vertices) {
    const Eigen::Vector3f single = p.cast<float>();
    file_.write(single.data(), 3 * sizeof(float));
  }
  ++added_;
}

void Pc2Writer::finish() {
  if (added_ != frames_) throw std::logic_error("Pc2Writer: frames are missing");
  file_.commit();
}

void write_obj(const std::filesystem::path& file, std::span<const sim::Vec3> vertices,
               std::span<const sim::Triangle> triangles) {
  std::string text;
  auto out = std::back_inserter(text);
  for (const sim::Vec3& p : vertices) fmt::format_to(out, "v {} {} {}\n", p.x(), p.y(), p.z());
  for (const sim::Triangle& t : triangles) fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  write_file_atomically(file, text);
}

}  // namespace softreel::assets
