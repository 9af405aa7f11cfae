#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assets/scene_colors.h"
#include "assets/scene_nearest.h"
#include "assets/scene_value.h"

namespace softreel::assets {

namespace {

struct UnitName {
  std::string_view name;
  double metres;
};
constexpr std::array kUnits = {UnitName{"m", 1},     UnitName{"cm", 0.01},   UnitName{"mm", 1e-3},
                               UnitName{"km", 1000}, UnitName{"in", 0.0254}, UnitName{"ft", 0.3048}};

template <class... Ts>
struct Overload : Ts... {
  using Ts::operator()...;
};

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\u{:04X}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

template <class Numbers>
std::string array_text(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers.begin(), numbers.end(), ", "));
}

std::string array_text(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }
std::string array_text(const Color& c) { return fmt::format("[{}, {}, {}]", c.r, c.g, c.b); }

template <class T>
std::string list_text(const std::vector<T>& list) {
  std::string text;
  for (const T& item : list) text += (text.empty() ? "" : ", ") + array_text(item);
  return list.empty() ? "" : "[" + text + "]";
}

template <class T>
std::string optional_text(const std::optional<T>& value) {
  if (!value) return {};
  if constexpr (std::is_same_v<T, double>) {
    return fmt::format("{}", *value);
  } else {
    return array_text(*value);
  }
}

}  // namespace

bool Range::holds(double value) const {
  return (open_lo ? value > lo : value >= lo) && (open_hi ? value < hi : value <= hi);
}

namespace {
// Bounds beyond `shown` are left out.
std::string range_text(const Range& r, double shown) {
  const bool lo = r.lo > -shown, hi = r.hi < shown;
  if (lo && hi && !r.open_lo && !r.open_hi) return fmt::format("{:.10g} to {:.10g}", r.lo, r.hi);
  std::vector<std::string> parts;
  if (lo) parts.push_back(fmt::format("{} {:.10g}", r.open_lo ? "above" : "at least", r.lo));
  if (hi) parts.push_back(fmt::format("{} {:.10g}", r.open_hi ? "below" : "at most", r.hi));
  return fmt::format("{}", fmt::join(parts, " and "));
}
}  // namespace

std::string Range::text() const { return range_text(*this, HUGE_VAL); }
std::string Range::short_text() const { return range_text(*this, 1e5); }

double metres_per(std::string_view name) {
  const auto it = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitName& u) { return u.name == name; });
  return it == kUnits.end() ? 0 : it->metres;
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const UnitName& unit : kUnits) names.emplace_back(unit.name);
  return names;
}

std::vector<std::string> accuracy_units() {
  std::vector<std::string> names = unit_names();
  names.insert(names.end(), {"px", "%"});
  return names;
}

std::vector<std::string> method_names(const MethodRef& value) {
  std::vector<std::string> names;
  for (const sim::MethodInfo& info : value.methods) names.emplace_back(info.name);
  return names;
}

std::string expected_text(const Key& key, const ValueRef& value, const std::string& allowed) {
  const std::string unit = *key.unit ? fmt::format(" [{}]", key.unit) : "";
  const std::string range = allowed.empty() ? "" : ", " + allowed;
  const std::string each = allowed.empty() ? "" : ", each " + allowed;
  return std::visit(
      Overload{
          [&](double*) { return "a number" + unit + range; },
          [&](std::optional<double>*) { return "a number" + unit + range; },
          [&](int*) { return "a whole number" + unit + range; },
          [](bool*) { return std::string("true or false"); },
          [](std::string*) { return std::string("a text in quotes"); },
          [&](Vec3*) { return "three numbers [x, y, z]" + unit + each; },
          [&](std::optional<Vec3>*) { return "three numbers [x, y, z]" + unit + each; },
          [&](std::array<double, 2>*) { return "two numbers [x, z]" + unit + each; },
          [&](std::optional<std::array<double, 2>>*) { return "two numbers [lowest, highest]" + unit + each; },
          [&](std::array<int, 2>*) { return "two whole numbers" + unit + each; },
          [&](std::array<int, 3>*) { return "three whole numbers" + unit + each; },
          [&](std::vector<int>*) { return "whole numbers [i, j, ...]" + each; },
          [&](std::vector<double>*) { return "a number" + unit + ", or a list of them" + each; },
          [&](std::vector<Vec3>*) { return "points [[x, y, z], ...]" + unit + each; },
          [&](std::vector<std::array<int, 2>>*) { return "pairs of whole numbers [[i, j], ...]" + each; },
          [](BodyName*) { return std::string("the name of a body, in quotes"); },
          [](std::array<BodyName, 2>*) { return std::string("the names of two bodies, [\"a\", \"b\"]"); },
          [](std::optional<Accuracy>*) {
            return "a number above 0 and a unit in quotes, such as \"1 mm\", \"0.5 px\" or \"0.1 %\"; units are " +
                   join_names(accuracy_units(), true);
          },
          [](Color*) { return std::string("a colour: \"#rrggbb\", [r, g, b] from 0 to 1, or a name"); },
          [](std::optional<Color>*) { return std::string("a colour: \"#rrggbb\", [r, g, b] from 0 to 1, or a name"); },
          [&](std::optional<Box>*) { return "two corners [[x, y, z], [x, y, z]]" + unit + ", the lower one first"; },
          [](const ChoiceRef& c) {
            return (c.names.size() > 1 ? "one of " : "") +
                   join_names(std::vector<std::string>(c.names.begin(), c.names.end()), true);
          },
          [](const FileRef&) { return std::string("a file name in quotes, relative to the scene file"); },
          [](const NameRef&) { return std::string("a name in quotes, without . = * and not only digits"); },
          [](const PresetRef& p) { return "one of " + join_names(p.names, true); },
          [](const MethodRef& m) { return "one of " + join_names(method_names(m), true); },
          [&](const ScaleRef&) { return "a number or three [x, y, z]" + unit + each; },
          [](const AxesRef&) { return std::string("a text of x, y and z, such as \"xz\""); },
          [&](const AutoRef&) { return "a whole number" + unit + range + ", or \"auto\""; },
          [&](const FormulaRef&) {
            return "a number" + unit + range + ", or a formula in x, y, z, t as a text such as \"sin(pi*x)*exp(-t)\"";
          },
          [&](const UnitRef&) {
            return "one of " + join_names(unit_names(), true) + ", or a number of metres" + range;
          },
      },
      value);
}

std::string value_text(const ValueRef& value) {
  return std::visit(
      Overload{
          [](double* v) { return fmt::format("{}", *v); },
          [](std::optional<double>* v) { return optional_text(*v); },
          [](int* v) { return fmt::format("{}", *v); },
          [](bool* v) { return std::string(*v ? "true" : "false"); },
          [](std::string* v) { return toml_string(*v); },
          [](Vec3* v) { return array_text(*v); },
          [](std::optional<Vec3>* v) { return optional_text(*v); },
          [](std::array<double, 2>* v) { return array_text(*v); },
          [](std::optional<std::array<double, 2>>* v) { return optional_text(*v); },
          [](std::array<int, 2>* v) { return array_text(*v); },
          [](std::array<int, 3>* v) { return array_text(*v); },
          [](std::vector<int>* v) { return array_text(*v); },
          [](std::vector<double>* v) {
            if (v->empty()) return std::string();
            return v->size() == 1 ? fmt::format("{}", v->front()) : array_text(*v);
          },
          [](std::vector<Vec3>* v) { return list_text(*v); },
          [](std::vector<std::array<int, 2>>* v) { return list_text(*v); },
          [](BodyName* v) { return v->name.empty() ? std::string() : toml_string(v->name); },
          [](std::array<BodyName, 2>* v) {
            if ((*v)[0].name.empty()) return std::string();
            return fmt::format("[{}, {}]", toml_string((*v)[0].name), toml_string((*v)[1].name));
          },
          [](std::optional<Accuracy>* v) {
            return *v ? fmt::format("\"{} {}\"", (*v)->value, (*v)->unit) : std::string();
          },
          [](Color* v) { return array_text(*v); },
          [](std::optional<Color>* v) { return optional_text(*v); },
          [](std::optional<Box>* v) {
            return *v ? fmt::format("[{}, {}]", array_text((*v)->lo), array_text((*v)->hi)) : "";
          },
          [](const ChoiceRef& v) { return toml_string(v.names[static_cast<size_t>(v.get(v.value))]); },
          [](const FileRef& v) { return v.path->empty() ? std::string() : toml_string(*v.path); },
          [](const NameRef& v) { return v.name->empty() ? std::string() : toml_string(*v.name); },
          [](const PresetRef& v) { return v.name->empty() ? std::string() : toml_string(*v.name); },
          [](const MethodRef& v) { return toml_string(*v.name); },
          [](const ScaleRef& v) { return array_text(*v.value); },
          [](const AxesRef& v) {
            std::string axes;
            for (size_t i = 0; i < 3; ++i)
              if ((*v.value)[i]) axes += "xyz"[i];
            return toml_string(axes);
          },
          [](const AutoRef& v) { return *v.value == 0 ? toml_string("auto") : fmt::format("{}", *v.value); },
          [](const FormulaRef& v) {
            const bool number = v.text->find_first_not_of("+-.0123456789e") == std::string::npos;
            return number && *v.text != "e" ? *v.text : toml_string(*v.text);
          },
          [](const UnitRef& v) { return fmt::format("{}", *v.metres); },
      },
      value);
}

std::vector<std::string> value_choices(const ValueRef& value) {
  if (const auto* choice = std::get_if<ChoiceRef>(&value))
    return std::vector<std::string>(choice->names.begin(), choice->names.end());
  if (const auto* preset = std::get_if<PresetRef>(&value)) return preset->names;
  if (const auto* method = std::get_if<MethodRef>(&value)) return method_names(*method);
  if (std::holds_alternative<UnitRef>(value)) return unit_names();
  if (std::holds_alternative<Color*>(value) || std::holds_alternative<std::optional<Color>*>(value))
    return color_names();
  return {};
}

}  // namespace softreel::assets
