#include "assets/raw_surface.h"

namespace softreel::assets {
namespace {

void write_optional(BlobWriter& out, const std::optional<double>& v) {
  out.value<std::uint8_t>(v.has_value());
  out.value(v.value_or(0.0));
}

std::optional<double> read_optional(BlobReader& in) {
  const bool has = in.value<std::uint8_t>() != 0;
  const auto v = in.value<double>();
  return has ? std::optional(v) : std::nullopt;
}

void write_part(BlobWriter& out, const SurfacePart& part) {
  out.text(part.name);
  out.value(part.first_triangle);
  out.value(part.triangle_count);
  out.value<std::uint8_t>(part.base_color.has_value());
  out.value(part.base_color.value_or(std::array<double, 3>{}));
  write_optional(out, part.metallic);
  write_optional(out, part.roughness);
  out.value<std::uint8_t>(part.emission.has_value());
  out.value(part.emission.value_or(std::array<double, 3>{}));
  for (const TextureSource* texture :
       {&part.texture, &part.normal_texture, &part.roughness_texture, &part.emission_texture}) {
    out.text(texture->file.string());
    out.array(texture->bytes);
  }
}

SurfacePart read_part(BlobReader& in) {
  SurfacePart part;
  part.name = in.text();
  part.first_triangle = in.value<int>();
  part.triangle_count = in.value<int>();
  const bool colored = in.value<std::uint8_t>() != 0;
  const auto color = in.value<std::array<double, 3>>();
  if (colored) part.base_color = color;
  part.metallic = read_optional(in);
  part.roughness = read_optional(in);
  const bool emits = in.value<std::uint8_t>() != 0;
  const auto emission = in.value<std::array<double, 3>>();
  if (emits) part.emission = emission;
  for (TextureSource* texture :
       {&part.texture, &part.normal_texture, &part.roughness_texture, &part.emission_texture}) {
    texture->file = in.text();
    texture->bytes = in.array<std::uint8_t>();
  }
  return part;
}

}  // namespace

std::string write_raw(const RawSurface& raw) {
  BlobWriter out;
  out.text(raw.error);
  out.array(raw.positions);
  out.array(raw.uv);
  out.array(raw.normals);
  out.array(raw.triangles);
  out.value<std::uint64_t>(raw.parts.size());
  for (const SurfacePart& part : raw.parts) write_part(out, part);
  out.value<std::uint64_t>(raw.missing_textures.size());
  for (const std::string& texture : raw.missing_textures) out.text(texture);
  out.value(raw.dropped_other);
  return std::move(out.bytes);
}

RawSurface read_raw(std::string_view bytes) {
  BlobReader in(bytes);
  RawSurface raw;
  raw.error = in.text();
  raw.positions = in.array<sim::Vec3>();
  raw.uv = in.array<Eigen::Vector2f>();
  raw.normals = in.array<Eigen::Vector3f>();
  raw.triangles = in.array<sim::Triangle>();
  for (auto n = in.value<std::uint64_t>(); n > 0; --n) raw.parts.push_back(read_part(in));
  for (auto n = in.value<std::uint64_t>(); n > 0; --n) raw.missing_textures.push_back(in.text());
  raw.dropped_other = in.value<std::int64_t>();
  if (!in.at_end()) throw BrokenBlob();
  return raw;
}

}  // namespace softreel::assets
