#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/arguments.h"
#include "app/compare_outputs.h"
#include "app/compare_page_parts.h"
#include "app/interrupt.h"
#include "app/markup.h"
#include "assets/atomic_file.h"
#include "render/image_io.h"
#include "render/png.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Inside <script>: nothing that ends it.
std::string script_text(const Json& json) {
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace), safe;
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string data_uri(const char* type, std::string_view bytes) {
  return fmt::format("data:image/{};base64,{}", type, base64(bytes));
}

std::string png_uri(const render::Image& image) {
  const std::vector<unsigned char> png = render::encode_png(image);
  return data_uri("png", {reinterpret_cast<const char*>(png.data()), png.size()});
}

/// The file as it is where browsers can show it.
std::string picture_uri(const fs::path& file) {
  if (file.empty()) return {};
  const std::vector<std::byte> bytes = render::read_picture_file(file);
  const std::string extension = file.extension().string();
  const char* type = extension == ".png"                           ? "png"
                     : extension == ".jpg" || extension == ".jpeg" ? "jpeg"
                     : extension == ".bmp"                         ? "bmp"
                                                                   : nullptr;
  if (type == nullptr) return png_uri(render::load_image(bytes, file.string()));
  return data_uri(type, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Json frame_figures(const FrameResult& f) {
  Json json = {{"name", f.name}, {"good", f.good}, {"text", describe(f)}};
  const bool compared = f.state == FrameState::kCompared && f.difference.same_size;
  json["mean"] = compared ? Json(f.difference.mean_levels) : Json(nullptr);
  json["flicker"] = compared ? Json(f.flicker) : Json(nullptr);
  json["flip"] = compared && f.flip ? Json(f.flip->mean) : Json(nullptr);
  return json;
}

Json frame_pictures(const Comparison& c, std::size_t i) {
  const FramePair& pair = c.pairs[i];
  Json json;
  json["reference"] = picture_uri(pair.reference);
  json["actual"] = picture_uri(pair.actual);
  if (!pair.reference.empty() && !pair.actual.empty()) {
    const FrameRule rule = c.rules.rule_for(pair.name, pair.number);
    json["difference"] = png_uri(picture_of_difference(pair, rule, ids_of(c.rules, rule, pair.name)));
  }
  json["texts"] = Json::array();
  for (const TextDifference& t : picture_texts(pair)) json["texts"].push_back({t.key, t.reference, t.actual});
  return json;
}

std::vector<std::size_t> worst_first(const std::vector<FrameResult>& frames) {
  std::vector<std::size_t> order(frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return is_worse(frames[a], frames[b]); });
  return order;
}

}  // namespace

void write_compare_page(const std::string& file, const Comparison& c, int pictures) {
  assets::AtomicFile out(file);
  const std::string title = fmt::format("{} against {}", c.actual, c.reference);
  out.write(
      fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
                  "<meta name=\"viewport\" content=\"width=device-width\"><link rel=\"icon\" "
                  "href=\"data:,\"><style>{1}</style></head>"
                  "<body class=\"{2}\">\n<h1>{3}: {0}</h1>\n<pre id=\"lines\">{4}</pre>\n",
                  escaped(title), kComparePageStyle, c.clip.good() ? "good" : "bad",
                  c.clip.good() ? "The same" : "Different", escaped(closing_lines(c))));
  out.write(kComparePageBody);
  out.write(
      fmt::format("<h2>How it was made</h2>\n<pre>{}\nsoftreel {}</pre>\n", escaped(c.command), escaped(version())));

  Json frames = Json::array();
  for (const FrameResult& f : c.clip.frames) frames.push_back(frame_figures(f));
  const std::vector<std::size_t> order = worst_first(c.clip.frames);
  out.write(fmt::format("<script>var frames={};var order={};var pictures={{}};</script>\n", script_text(frames),
                        script_text(Json(order))));
  int left = pictures;
  for (const std::size_t i : order) {
    if (left == 0 || c.clip.frames[i].state == FrameState::kSkipped) continue;
    stop_if_interrupted();
    --left;
    out.write(fmt::format("<script>pictures[{}]={};</script>\n", i, script_text(frame_pictures(c, i))));
  }
  out.write(fmt::format("<script>{}</script></body></html>\n", kComparePageScript));
  out.commit();
}

}  // namespace softreel::app
