#include "assets/scene_override.h"

#include <fmt/format.h>

#include "assets/scene_nearest.h"
#include "assets/scene_reference.h"
#include "assets/scene_unknown.h"

namespace softreel::assets {

namespace {

std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\n\r";
  const size_t begin = text.find_first_not_of(kSpace);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<std::string> entry_names(const Node& list) {
  std::vector<std::string> names;
  for (const Node& entry : list.children) {
    const Node* name = entry.find("name");
    names.push_back(name && name->kind == Node::Kind::kString ? name->text : std::to_string(names.size() + 1));
  }
  return names;
}

class Override {
 public:
  Override(const std::string& text, std::vector<Problem>& problems)
      : origin_{"--set " + text, 0, 0}, problems_(problems) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      fail("expected key=value, such as render.samples=4");
      return;
    }
    parts_ = split(trimmed(text.substr(0, equals)));
    try {
      value_ = parse_override_value(trimmed(text.substr(equals + 1)), origin_);
    } catch (const UserError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
      parts_.clear();
    }
  }

  void apply(Node& root) {
    if (!parts_.empty()) set(root, 0, "");
  }

 private:
  // `table` is the table at `section` of the reference; the next part to be found in it is parts_[i].
  void set(Node& table, size_t i, const std::string& section) {
    const std::string path = section.empty() ? parts_[i] : section + "." + parts_[i];
    const KeyInfo* info = find_key(path);
    if (!info) return fail(unknown_key_text(section, parts_[i]));
    Node* child = table.find(parts_[i]);
    if (i + 1 == parts_.size()) {
      Node& target = child ? *child : table.children.emplace_back();
      target = value_;
      target.key = parts_[i];
      return;
    }
    if (info->kind == KeyInfo::Kind::kValue)
      return fail(fmt::format("\"{}\" is a single value and has no \"{}\"", path, parts_[i + 1]));
    if (info->kind == KeyInfo::Kind::kList) return child ? set_entries(*child, i + 1, path) : fail(no_entry(path));
    if (!child) {
      child = &table.children.emplace_back();
      child->key = parts_[i];
      child->where = child->key_where = origin_;
    }
    if (!child->is_table()) *child = expand_bare(*child, info->bare);
    if (child->is_table()) set(*child, i + 1, path);  // if not, the reader says what is wrong with it
  }

  void set_entries(Node& list, size_t i, const std::string& section) {
    if (!list.is_array()) return;
    if (list.children.empty()) return fail(no_entry(section));
    if (i + 1 == parts_.size())
      return fail(fmt::format("\"{}\" is a whole entry of [[{}]]; add the key to be set", parts_[i], section));
    if (parts_[i] == "*") {
      for (Node& entry : list.children)
        if (entry.is_table()) set(entry, i + 1, section);
      return;
    }
    const Node* entry = list.step(parts_[i]);
    if (!entry) entry = made_up(list, parts_[i], section);
    if (!entry) {
      const std::vector<std::string> names = entry_names(list);
      const std::string nearest = nearest_name(parts_[i], names);
      return fail(fmt::format("there is no \"{}\" in [[{}]]; {}", parts_[i], section,
                              nearest.empty() ? "there is: " + join_names(names) + ", or * for all"
                                              : fmt::format("did you mean \"{}\"?", nearest)));
    }
    if (entry->is_table()) set(const_cast<Node&>(*entry), i + 1, section);
  }

  // "soft-2" is the name that the second soft body has when the file gives it none.
  static const Node* made_up(const Node& list, const std::string& part, const std::string& section) {
    if (!part.starts_with(section + "-")) return nullptr;
    const Node* entry = list.step(part.substr(section.size() + 1));
    return entry && !entry->find("name") ? entry : nullptr;
  }

  static std::string no_entry(const std::string& section) {
    return fmt::format("the scene has no [[{}]] to be changed", section);
  }

  void fail(std::string message) {
    // The same key may be wrong in every entry that * stands for; once is enough.
    if (!problems_.empty() && problems_.back().file == origin_.file && problems_.back().message == message) return;
    problems_.push_back({origin_.file, 0, 0, std::move(message)});
  }

  Where origin_;
  std::vector<std::string> parts_;
  Node value_;
  std::vector<Problem>& problems_;
};

}  // namespace

void apply_overrides(Node& root, std::span<const std::string> overrides, std::vector<Problem>& problems) {
  for (const std::string& text : overrides) Override(text, problems).apply(root);
}

}  // namespace softreel::assets
