#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "assets/formula.h"
#include "assets/scene_colors.h"
#include "assets/scene_nearest.h"
#include "assets/scene_value.h"

namespace softreel::assets {

namespace {

// Reads one value; the overloads of `read` return false after having noted a fault.
class ValueReader {
 public:
  ValueReader(const Key& key, const ValueRef& value) : key_(key), value_(value) {}

  std::optional<Fault> fault;

  bool read(const Node& node, double* out) {
    if (!node.is_number()) return fail(node);
    const double number = node.as_double();
    if (!std::isfinite(number)) return fail(node);
    if (!key_.range.holds(number)) return out_of_range(node, number);
    *out = number;
    return true;
  }

  bool read(const Node& node, int* out) {
    if (!node.is_number()) return fail(node);
    const double number = node.as_double();  // 4.0 and 1e3 are whole numbers too
    const bool whole = std::isfinite(number) && number == std::floor(number);
    if (!whole) return fail(node);
    if (!key_.range.holds(number)) return out_of_range(node, number);
    if (std::abs(number) > std::numeric_limits<int>::max()) return fail(node);
    *out = static_cast<int>(number);
    return true;
  }

  bool read(const Node& node, bool* out) {
    if (node.kind != Node::Kind::kBool) return fail(node);
    *out = node.boolean;
    return true;
  }

  bool read(const Node& node, std::string* out) {
    if (node.kind != Node::Kind::kString) return fail(node);
    *out = node.text;
    return true;
  }

  bool read(const Node& node, Vec3* out) {
    std::array<double, 3> v{};
    if (!read(node, &v)) return false;
    *out = Vec3(v[0], v[1], v[2]);
    return true;
  }

  template <class T, size_t n>
  bool read(const Node& node, std::array<T, n>* out) {
    if (!node.is_array() || node.children.size() != n) return fail(node);
    std::array<T, n> values{};
    for (size_t i = 0; i < n; ++i)
      if (!read(node.children[i], &values[i])) return false;
    *out = values;
    return true;
  }

  template <class T>
  bool read(const Node& node, std::vector<T>* out) {
    if (!node.is_array()) return fail(node);
    std::vector<T> values(node.children.size());
    for (size_t i = 0; i < values.size(); ++i)
      if (!read(node.children[i], &values[i])) return false;
    *out = std::move(values);
    return true;
  }

  // One number stands for all.
  bool read(const Node& node, std::vector<double>* out) {
    if (!node.is_number()) return node.children.empty() ? fail(node) : read<double>(node, out);
    double number = 0;
    if (!read(node, &number)) return false;
    out->assign(1, number);
    return true;
  }

  bool read(const Node& node, BodyName* out) {
    if (node.kind != Node::Kind::kString || node.text.empty()) return fail(node);
    out->name = node.text;
    return true;
  }

  bool read(const Node& node, Color* out) {
    if (node.kind == Node::Kind::kString) {
      const std::optional<Color> color = parse_color(node.text);
      if (!color) return fail(node, node.text.starts_with('#') ? "" : meant(node.text, color_names()));
      *out = *color;
      return true;
    }
    std::array<double, 3> rgb{};
    if (!read(node, &rgb)) return false;
    *out = {rgb[0], rgb[1], rgb[2]};
    return true;
  }

  bool read(const Node& node, Box* out) {
    if (!node.is_array() || node.children.size() != 2) return fail(node);
    Box box;
    if (!read(node.children[0], &box.lo) || !read(node.children[1], &box.hi)) return false;
    if ((box.lo.array() > box.hi.array()).any())
      return fail(node, "the first corner has to be the lower one in x, y and z");
    *out = box;
    return true;
  }

  template <class T>
  bool read(const Node& node, std::optional<T>* out) {
    T value{};
    if (!read(node, &value)) return false;
    *out = value;
    return true;
  }

  bool read(const Node& node, Accuracy* out) {
    if (node.is_number()) return fail(node, fmt::format("say what it is measured in, \"{} mm\"", node.found()));
    if (node.kind != Node::Kind::kString) return fail(node);
    Accuracy read;
    const char* end = node.text.data() + node.text.size();
    const auto [rest, error] = std::from_chars(node.text.data(), end, read.value);
    if (error != std::errc() || !std::isfinite(read.value) || !(read.value > 0)) return fail(node);
    read.unit = std::string(rest, end);
    read.unit.erase(0, read.unit.find_first_not_of(' '));
    const std::vector<std::string> units = accuracy_units();
    if (std::find(units.begin(), units.end(), read.unit) == units.end()) return fail(node, meant(read.unit, units));
    *out = read;
    return true;
  }

  bool read(const Node& node, const ChoiceRef& out) {
    const std::vector<std::string> names(out.names.begin(), out.names.end());
    std::string text = node.text;
    if (node.kind == Node::Kind::kBool) text = node.boolean ? "on" : "off";  // where there are such names
    const auto it = std::find(names.begin(), names.end(), text);
    if (it == names.end()) return fail(node, node.kind == Node::Kind::kString ? meant(text, names) : "");
    out.set(out.value, static_cast<int>(it - names.begin()));
    return true;
  }

  bool read(const Node& node, const FileRef& out) {
    if (node.kind != Node::Kind::kString || node.text.empty() || node.text.find('\0') != std::string::npos)
      return fail(node);
    *out.path = node.text;
    return true;
  }

  bool read(const Node& node, const NameRef& out) {
    constexpr size_t kLongest = 64;
    if (node.kind != Node::Kind::kString || node.text.empty()) return fail(node);
    if (node.text.size() > kLongest) return fail(node, fmt::format("at most {} letters", kLongest));
    const auto forbidden = [](char c) {
      return c == '.' || c == '=' || c == '*' || static_cast<unsigned char>(c) < 0x20;
    };
    const bool has_letter = node.text.find_first_not_of("0123456789") != std::string::npos;
    if (!has_letter || std::any_of(node.text.begin(), node.text.end(), forbidden)) return fail(node);
    *out.name = node.text;
    return true;
  }

  bool read(const Node& node, const PresetRef& out) {
    const bool known =
        node.kind == Node::Kind::kString && std::find(out.names.begin(), out.names.end(), node.text) != out.names.end();
    if (!known) return fail(node, node.kind == Node::Kind::kString ? meant(node.text, out.names) : "");
    *out.name = node.text;
    return true;
  }

  bool read(const Node& node, const MethodRef& out) {
    const std::vector<std::string> names = method_names(out);
    const bool known =
        node.kind == Node::Kind::kString && std::find(names.begin(), names.end(), node.text) != names.end();
    if (!known) return fail(node, node.kind == Node::Kind::kString ? meant(node.text, names) : "");
    *out.name = node.text;
    return true;
  }

  bool read(const Node& node, const ScaleRef& out) {
    if (!node.is_number()) return read(node, out.value);
    double scale = 1;
    if (!read(node, &scale)) return false;
    *out.value = Vec3::Constant(scale);
    return true;
  }

  bool read(const Node& node, const AxesRef& out) {
    std::array<bool, 3> axes = {};
    if (node.kind != Node::Kind::kString || node.text.empty()) return fail(node);
    for (char c : node.text) {
      if (c < 'x' || c > 'z') return fail(node);
      axes[static_cast<size_t>(c - 'x')] = true;
    }
    *out.value = axes;
    return true;
  }

  bool read(const Node& node, const AutoRef& out) {
    if (node.kind != Node::Kind::kString) return read(node, out.value);
    if (node.text != "auto") return fail(node);
    *out.value = 0;
    return true;
  }

  bool read(const Node& node, const FormulaRef& out) {
    if (node.is_number()) {
      double number = 0;
      if (!read(node, &number)) return false;
      *out.text = fmt::format("{}", number);
      return true;
    }
    if (node.kind != Node::Kind::kString) return fail(node);
    if (const auto mistake = formula_fault(node.text))
      return fail(node, fmt::format("{}. A formula is made of {}", *mistake, formula_help()));
    *out.text = node.text;
    return true;
  }

  bool read(const Node& node, const UnitRef& out) {
    if (node.kind != Node::Kind::kString) return read(node, out.metres);
    const double metres = metres_per(node.text);
    if (metres == 0) return fail(node, meant(node.text, unit_names()));
    *out.metres = metres;
    return true;
  }

 private:
  bool fail(const Node& node, const std::string& hint = "") { return fail(node, key_.range.short_text(), hint); }

  bool out_of_range(const Node& node, double number) {
    return fail(node, key_.range.text(), number >= key_.range.hi ? key_.range.why_hi : key_.range.why_lo);
  }

  bool fail(const Node& node, const std::string& range, const std::string& hint) {
    fault = Fault{node.where, fmt::format("found {}, expected {}", node.found(), expected_text(key_, value_, range))};
    if (!hint.empty()) fault->message += "; " + hint;
    return false;
  }

  static std::string meant(const std::string& word, const std::vector<std::string>& names) {
    const std::string nearest = nearest_name(word, names);
    return nearest.empty() ? "" : fmt::format("did you mean \"{}\"?", nearest);
  }

  const Key& key_;
  const ValueRef& value_;
};

}  // namespace

std::optional<Fault> read_value(const Node& node, const Key& key, const ValueRef& value) {
  ValueReader reader(key, value);
  std::visit([&](const auto& out) { reader.read(node, out); }, value);
  return reader.fault;
}

}  // namespace softreel::assets
