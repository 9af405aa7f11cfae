#include "app/export_clip.h"

#include <fmt/format.h>

#include <cctype>
#include <memory>
#include <set>
#include <string_view>

#include "app/drawn_field.h"
#include "app/interrupt.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "assets/export_pc2.h"
#include "assets/export_ply.h"
#include "assets/export_vtu.h"

namespace softreel::app {
namespace {

using sim::Vec3;

/// A body's name as the beginning of a file's: no folders, nothing that other programs stumble over.
std::string file_stem(const std::string& body, std::set<std::string>& taken) {
  constexpr std::size_t kLongest = 100;
  constexpr std::string_view kAllowed = "-_+.";
  std::string stem = body.substr(0, kLongest);
  for (char& c : stem)
    if (static_cast<unsigned char>(c) < 128 && !std::isalnum(c) && kAllowed.find(c) == kAllowed.npos) c = '_';
  if (stem.empty() || stem[0] == '.' || stem[0] == '-') stem = "_" + stem;
  const std::string wanted = stem;
  for (int n = 2; !taken.insert(stem).second; ++n) stem = fmt::format("{}_{}", wanted, n);
  return stem;
}

struct ExportBody {
  std::string name;          // of its files
  int first = 0, count = 0;  // vertices of the state
  int surface_count = 0;     // of them, those that the surface uses come first
  const std::vector<sim::Triangle>* triangles = nullptr;
  const std::vector<sim::Tet>* tets = nullptr;
  const BallsAndRods* net = nullptr;  // exported as it is drawn
  std::vector<sim::Triangle> net_triangles = {};
  int field = -1;                                   // its number, for a field
  std::shared_ptr<FieldSurface> surface = nullptr;  // of a field: as it is drawn
};

std::vector<ExportBody> bodies_of(const assets::Scene& scene, const Shapes& shapes) {
  std::vector<ExportBody> bodies;
  std::set<std::string> taken;
  int first = 0;
  for (size_t i = 0; i < scene.soft.size(); ++i) {
    const SolidShape& s = shapes.soft[i];
    const int count = static_cast<int>(s.rest.vertices.size());
    bodies.push_back({file_stem(scene.soft[i].name, taken), first, count, s.drawn.position_count,
                      &s.drawn.surface.welded.triangles, &s.rest.tets});
    first += count;
  }
  for (size_t i = 0; i < scene.cloth.size(); ++i) {
    const ClothShape& c = shapes.cloth[i];
    const int count = static_cast<int>(c.rest.vertices.size());
    bodies.push_back({file_stem(scene.cloth[i].name, taken), first, count, count, &c.rest.triangles, nullptr});
    first += count;
  }
  for (size_t i = 0; i < scene.springs.size(); ++i) {
    const SpringShape& s = shapes.springs[i];
    const int count = static_cast<int>(s.rest.size());
    if (s.drawn) {
      ExportBody body{file_stem(scene.springs[i].name, taken), first, count, 0, nullptr, nullptr, &*s.drawn};
      const render::SurfaceMesh mesh = s.drawn->mesh();
      body.surface_count = static_cast<int>(mesh.position_count);
      for (const glm::uvec3& t : mesh.triangles)
        body.net_triangles.push_back({static_cast<int>(t.x), static_cast<int>(t.y), static_cast<int>(t.z)});
      bodies.push_back(std::move(body));
    }
    first += count;
  }
  for (ExportBody& body : bodies)
    if (body.net) body.triangles = &body.net_triangles;
  for (size_t i = 0; i < scene.fields.size(); ++i) {
    const ClothShape& f = shapes.fields[i];
    const int count = static_cast<int>(f.rest.vertices.size());
    ExportBody body{file_stem(scene.fields[i].name, taken), 0, count, count, &f.rest.triangles};
    body.field = static_cast<int>(i);
    body.surface = std::make_shared<FieldSurface>(scene.fields[i], f);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<Vec3> points(const Eigen::VectorXd& stacked, int first, int count) {
  std::vector<Vec3> result;
  for (int i = first; i < first + count; ++i) result.emplace_back(stacked.segment<3>(3 * i));
  return result;
}

std::span<const double> doubles(const Eigen::VectorXd& v) { return {v.data(), static_cast<size_t>(v.size())}; }

/// What the surface of a body or field is made of.
std::vector<Vec3> surface_points(const ExportBody& body, const CachedFrame& frame) {
  if (body.surface) return body.surface->points(frame.fields.at(static_cast<size_t>(body.field)).value);
  if (!body.net) return points(frame.state.x, body.first, body.surface_count);
  std::vector<Vec3> result;
  for (const glm::vec3& p : body.net->positions(frame.state.x, body.first)) result.emplace_back(p.x, p.y, p.z);
  return result;
}

}  // namespace

void export_clip(const assets::Scene& scene, const Shapes& shapes, const ClipCache& cache,
                 const std::vector<int>& frames, const std::string& format, const std::filesystem::path& folder) {
  assets::make_folders(folder);
  const std::vector<ExportBody> bodies = bodies_of(scene, shapes);
  std::vector<std::unique_ptr<assets::Pc2Writer>> point_caches;
  std::vector<assets::PvdEntry> series;
  for (size_t f = 0; f < frames.size(); ++f) {
    stop_if_interrupted();
    const std::optional<CachedFrame> data = cache.read(frames[f]);
    if (!data)
      throw assets::UserError(assets::ErrorKind::kInput, cache.folder().string(),
                              fmt::format("the cached state of frame {} went missing", frames[f]));
    for (size_t b = 0; b < bodies.size(); ++b) {
      const ExportBody& body = bodies[b];
      const std::string name = fmt::format("{}_{:04d}.{}", body.name, frames[f], format);
      if (format == "vtu") {
        if (body.net || body.surface) {
          const std::vector<Vec3> x = surface_points(body, *data);
          assets::VtuFrame vtu{x, {}, *body.triangles, {}};
          if (body.surface) {
            const CachedField& field = data->fields.at(static_cast<size_t>(body.field));
            vtu.values = doubles(field.value);
            vtu.rates = doubles(field.rate);
          }
          assets::write_vtu(folder / name, vtu);
          series.push_back({data->state.t, name, static_cast<int>(b), body.name});
          continue;
        }
        const std::vector<Vec3> x = points(data->state.x, body.first, body.count);
        const std::vector<Vec3> v = points(data->state.v, body.first, body.count);
        if (body.tets)
          assets::write_vtu(folder / name, {x, *body.tets, {}, v});
        else
          assets::write_vtu(folder / name, {x, {}, *body.triangles, v});
        series.push_back({data->state.t, name, static_cast<int>(b), body.name});
        continue;
      }
      const std::vector<Vec3> x = surface_points(body, *data);
      if (format == "ply") {
        assets::write_ply(folder / name, x, *body.triangles);
        continue;
      }
      if (f == 0) {
        assets::write_obj(folder / (body.name + ".obj"), x, *body.triangles);
        point_caches.push_back(std::make_unique<assets::Pc2Writer>(folder / (body.name + ".pc2"), body.surface_count,
                                                                   static_cast<int>(frames.size())));
      }
      point_caches[b]->add(x);
    }
  }
  for (const auto& writer : point_caches) writer->finish();
  if (format == "vtu") assets::write_pvd(folder / "clip.pvd", series);
}

}  // namespace softreel::app
