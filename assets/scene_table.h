#pragma once
// The form of the table of keys (scene_keys.cpp): a walk over a Scene that shows every key, with its description and a
// reference to its value, to a visitor. Reader, listing, reference and hashes are visitors. A new key is one line
// there.
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "assets/scene.h"
#include "assets/scene_names.h"
#include "sim/catalogue.h"

namespace softreel::assets {

/// What has to be done again when a key changes.
enum class Role {
  kPhysics,  ///< simulate
  kPicture,  ///< only render
  kNeither   ///< nothing: names, limits on time
};

/// Allowed values of a number, or of each number in a list.
struct Range {
  double lo = -1e12, hi = 1e12;
  bool open_lo = false, open_hi = false;  ///< the bound itself is not allowed
  const char* why_lo = "";                ///< reason for a bound, where it is not plain
  const char* why_hi = "";

  bool holds(double value) const;
  std::string text() const;        ///< "above 0 and at most 10000"
  std::string short_text() const;  ///< without bounds so far out that nobody needs to read them
};

struct Key {
  const char* name;
  Role role;
  const char* unit;  ///< empty: none
  Range range;
  const char* help;
};

/// One of `names`, kept in an enumeration.
struct ChoiceRef {
  void* value;
  int (*get)(const void*);
  void (*set)(void*, int);
  Names names;
};

struct FileRef {
  std::string* path;
};  ///< a file, relative to the scene
struct NameRef {
  std::string* name;
};  ///< of a body or collider
struct PresetRef {
  std::string* name;
  std::vector<std::string> names;
};  ///< of a material
/// One of the physics' methods, by its name.
struct MethodRef {
  std::string* name;
  sim::Catalogue methods;
};
struct ScaleRef {
  Vec3* value;
};  ///< a number or three
struct AxesRef {
  std::array<bool, 3>* value;
};  ///< "xyz" or some of them
struct UnitRef {
  double* metres;
};  ///< a name such as "mm", or metres

/// A whole number, or "auto" (kept as 0).
struct AutoRef {
  int* value;
};

/// A number or a formula (formula.h), kept as text.
struct FormulaRef {
  std::string* text;
};

using ValueRef = std::variant<double*, std::optional<double>*, int*, bool*, std::string*, Vec3*, std::optional<Vec3>*,
                              std::array<double, 2>*, std::optional<std::array<double, 2>>*, std::array<int, 2>*,
                              std::array<int, 3>*, std::vector<int>*, std::vector<double>*, std::vector<Vec3>*,
                              std::vector<std::array<int, 2>>*, BodyName*, std::array<BodyName, 2>*,
                              std::optional<Accuracy>*, Color*, std::optional<Color>*, std::optional<Box>*, ChoiceRef,
                              FileRef, NameRef, PresetRef, MethodRef, ScaleRef, AxesRef, UnitRef, FormulaRef, AutoRef>;

/// A table of keys inside another.
struct Section {
  const char* name;
  const char* help;
  std::vector<const char*> bare = {};  ///< keys that a bare value in place of the table stands for
};

class KeyVisitor;
using KeyWalk = std::function<void(KeyVisitor&)>;

struct SectionRef {
  bool present;                  ///< optional ones may be absent
  std::function<void()> create;  ///< makes it present
  KeyWalk keys;                  ///< of the section, or of a default one when absent
};

struct ListRef {
  size_t size;
  std::function<void(size_t, KeyVisitor&)> keys;  ///< of an entry; of a default one when the index is `size`
  std::function<void()> append;                   ///< adds a default entry
  KeyWalk last;                                   ///< of the entry that was appended last
};

class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;
  virtual void key(const Key& key, const ValueRef& value) = 0;
  virtual void section(const Section& section, const SectionRef& ref) = 0;
  virtual void list(const Section& section, const ListRef& ref) = 0;

  // For rules that tie keys together (scene_rules.cpp); only the reader answers. Paths start at the keys just walked.
  virtual bool reading() const { return false; }
  virtual bool given(std::string_view) const { return false; }
  virtual void problem(std::string_view, std::string) {}
  virtual void note(std::string_view, std::string) {}  ///< no mistake, but the user should know
};

/// Shows every key of `scene` in the order of the reference.
void walk_scene(KeyVisitor& visitor, Scene& scene);

// --- what the table is written with ---------------------------------------------------------------------------------

template <class Enum>
ChoiceRef choice(Enum& value) {
  return {&value, [](const void* v) { return static_cast<int>(*static_cast<const Enum*>(v)); },
          [](void* v, int i) { *static_cast<Enum*>(v) = static_cast<Enum>(i); }, names_of(value)};
}

template <class T>
SectionRef keys_of(T& value) {
  return {true, [] {}, [&value](KeyVisitor& v) { walk(v, value); }};
}

template <class T>
SectionRef keys_of(std::optional<T>& value) {
  return {value.has_value(), [&value] { value.emplace(); },
          [&value](KeyVisitor& v) {
            T sample;
            walk(v, value ? *value : sample);
          }};
}

template <class T>
ListRef keys_of(std::vector<T>& items) {
  return {items.size(),
          [&items](size_t i, KeyVisitor& v) {
            T sample;
            walk(v, i < items.size() ? items[i] : sample);
          },
          [&items] { items.emplace_back(); }, [&items](KeyVisitor& v) { walk(v, items.back()); }};
}

}  // namespace softreel::assets
