#include "app/compare_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/frame_range.h"
#include "assets/atomic_file.h"
#include "assets/error.h"
#include "assets/scene_nearest.h"
#include "assets/scene_tree.h"

namespace softreel::app {
namespace {

using assets::ErrorKind;
using assets::Node;
using assets::Problem;
using assets::UserError;

constexpr std::size_t kMaxFile = 1 << 20;  // [bytes] of rules

[[noreturn]] void refuse(const assets::Where& where, const std::string& message) {
  throw UserError(ErrorKind::kUsage, std::vector{Problem{where.file, where.line, where.column, message}});
}

void check_keys(const Node& table, const std::vector<std::string>& allowed) {
  for (const Node& child : table.children) {
    if (std::find(allowed.begin(), allowed.end(), child.key) != allowed.end()) continue;
    const std::string nearest = assets::nearest_name(child.key, allowed);
    refuse(child.key_where, fmt::format("unknown key \"{}\"{}; allowed are {}", child.key,
                                        nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest),
                                        fmt::join(allowed, ", ")));
  }
}

std::string text_of(const Node& node) {
  if (node.kind != Node::Kind::kString)
    refuse(node.where, fmt::format("{}: found {}, expected a string", node.key, node.found()));
  return node.text;
}

double positive(const Node& node) {
  if (!node.is_number() || !(node.as_double() > 0) || !std::isfinite(node.as_double()))
    refuse(node.where, fmt::format("{}: found {}, expected a number above 0", node.key, node.found()));
  return node.as_double();
}

int whole(const Node& node, int least) {
  if (node.kind != Node::Kind::kInteger || node.integer < least || node.integer > 65535)
    refuse(node.where, fmt::format("found {}, expected a whole number of {} to 65535", node.found(), least));
  return static_cast<int>(node.integer);
}

std::string where_text(const assets::Where& w) { return Problem{w.file, w.line, w.column, "tolerance"}.text(); }

void read_masks(const Node& list, FrameRule& rule) {
  if (!list.is_array()) refuse(list.where, fmt::format("mask: found {}, expected [[mask]] tables", list.found()));
  for (const Node& mask : list.children) {
    if (!mask.is_table()) refuse(mask.where, fmt::format("mask: found {}, expected a table", mask.found()));
    check_keys(mask, {"rectangle", "body"});
    if (mask.children.size() != 1)
      refuse(mask.where, "mask: expected either rectangle = [x, y, width, height] or body = ID");
    const Node& what = mask.children.front();
    if (what.key == "body") {
      rule.ids.push_back(whole(what, 0));
      continue;
    }
    if (!what.is_array() || what.children.size() != 4)
      refuse(what.where, fmt::format("rectangle: found {}, expected [x, y, width, height] [px]", what.found()));
    rule.rectangles.push_back({whole(what.children[0], 0), whole(what.children[1], 0), whole(what.children[2], 1),
                               whole(what.children[3], 1)});
  }
}

/// "10,20,64,48"
render::PixelRectangle parse_rectangle(const std::string& text) {
  int values[4];
  const char *at = text.data(), *end = at + text.size();
  for (int i = 0; i < 4; ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool fits = error == std::errc() && values[i] >= (i < 2 ? 0 : 1) && values[i] <= 65535 &&
                      (i < 3 ? next != end && *next == ',' : next == end);
    if (!fits)
      throw UserError(
          ErrorKind::kUsage,
          fmt::format("--mask: found \"{}\", expected x,y,width,height in pixels from the left top corner", text));
    at = next + 1;
  }
  return {values[0], values[1], values[2], values[3]};
}

}  // namespace

CompareRules::CompareRules(const CompareArguments& a) {
  if (!a.rules.empty()) read_file(a.rules);
  if (!a.tolerance.empty()) all_.tolerance = parse_tolerance(a.tolerance, all_.tolerance, "--tolerance");
  for (const std::string& mask : a.masks) all_.rectangles.push_back(parse_rectangle(mask));
  all_.ids.insert(all_.ids.end(), a.mask_ids.begin(), a.mask_ids.end());
  if (!a.ids.empty()) ids_ = a.ids;
  if (a.flip_distance > 0) pixels_per_degree_ = a.flip_distance;
  const bool by_id = !all_.ids.empty() || std::any_of(exceptions_.begin(), exceptions_.end(),
                                                      [](const Exception& e) { return !e.rule.ids.empty(); });
  if (by_id && ids_.empty())
    throw UserError(ErrorKind::kUsage,
                    "a mask by body id needs the pictures of the ids: --ids FOLDER, or ids = \"FOLDER\" in the rules");
}

void CompareRules::read_file(const std::string& file) {
  const Node root = assets::parse_toml(assets::read_file(file, kMaxFile), file);
  check_keys(root, {"tolerance", "flicker", "ids", "pixels_per_degree", "mask", "frames"});
  if (const Node* n = root.find("tolerance")) all_.tolerance = parse_tolerance(text_of(*n), {}, where_text(n->where));
  if (const Node* n = root.find("flicker")) flicker_limit_ = positive(*n);
  if (const Node* n = root.find("ids")) ids_ = (std::filesystem::path(file).parent_path() / text_of(*n)).string();
  if (const Node* n = root.find("pixels_per_degree")) pixels_per_degree_ = positive(*n);
  if (const Node* n = root.find("mask")) read_masks(*n, all_);
  const Node* frames = root.find("frames");
  if (!frames) return;
  if (!frames->is_array())
    refuse(frames->where, fmt::format("frames: found {}, expected [[frames]] tables", frames->found()));
  for (const Node& table : frames->children) {
    if (!table.is_table()) refuse(table.where, fmt::format("frames: found {}, expected a table", table.found()));
    check_keys(table, {"frames", "tolerance", "mask", "skip", "why"});
    Exception e;
    const Node* which = table.find("frames");
    if (!which) refuse(table.where, "frames: says for no frame; expected frames = \"10-20\" or frames = \"NAME.png\"");
    e.frames = text_of(*which);
    e.where = Problem{which->where.file, which->where.line, which->where.column, ""}.text();
    if (const Node* n = table.find("tolerance")) {
      e.tolerance = text_of(*n);
      parse_tolerance(e.tolerance, {}, where_text(n->where));  // a mistake is told now, with its place
    }
    if (const Node* n = table.find("mask")) read_masks(*n, e.rule);
    if (const Node* n = table.find("why")) e.rule.why = text_of(*n);
    if (const Node* n = table.find("skip")) {
      if (n->kind != Node::Kind::kBool)
        refuse(n->where, fmt::format("skip: found {}, expected true or false", n->found()));
      e.rule.skip = n->boolean;
    }
    exceptions_.push_back(std::move(e));
  }
}

void CompareRules::resolve(int last) {
  for (Exception& e : exceptions_) {
    if (e.frames.find('.') != std::string::npos) continue;  // the name of a file
    try {
      e.numbers = parse_frames(e.frames, std::max(last, 1));
    } catch (const UserError& error) {
      throw UserError(ErrorKind::kUsage, e.where + error.what());
    }
  }
}

FrameRule CompareRules::rule_for(const std::string& name, int number) const {
  FrameRule rule = all_;
  for (const Exception& e : exceptions_) {
    if (e.frames != name && !std::binary_search(e.numbers.begin(), e.numbers.end(), number)) continue;
    if (!e.tolerance.empty()) rule.tolerance = parse_tolerance(e.tolerance, rule.tolerance, "tolerance");
    rule.rectangles.insert(rule.rectangles.end(), e.rule.rectangles.begin(), e.rule.rectangles.end());
    rule.ids.insert(rule.ids.end(), e.rule.ids.begin(), e.rule.ids.end());
    rule.skip = rule.skip || e.rule.skip;
    if (!e.rule.why.empty()) rule.why = e.rule.why;
  }
  return rule;
}

}  // namespace softreel::app
