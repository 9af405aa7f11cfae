#include "assets/scene_canonical.h"

#include <algorithm>

#include "assets/scene_value.h"

namespace softreel::assets {

namespace {

// Entries of lists count by their number: a body's new name changes nothing.
class Writer : public KeyVisitor {
 public:
  explicit Writer(Role role) : role_(role) {}

  std::string text;

  void key(const Key& key, const ValueRef& value) override {
    if (key.role == role_) text += prefix_ + key.name + " = " + canonical_text(value) + "\n";
  }

  void section(const Section& section, const SectionRef& ref) override {
    if (ref.present) enter(std::string(section.name) + ".", ref.keys);
  }

  void list(const Section& section, const ListRef& ref) override {
    for (size_t i = 0; i < ref.size; ++i) {
      const std::string part = std::string(section.name) + "." + std::to_string(i + 1) + ".";
      enter(part, [&](KeyVisitor& v) { ref.keys(i, v); });
    }
  }

 private:
  // So do the bodies that are spoken of.
  static std::string canonical_text(const ValueRef& value) {
    if (const auto* body = std::get_if<BodyName*>(&value)) return (*body)->place;
    if (const auto* two = std::get_if<std::array<BodyName, 2>*>(&value))
      return (**two)[0].place + ", " + (**two)[1].place;
    return value_text(value);
  }

  void enter(const std::string& part, const KeyWalk& keys) {
    const std::string outer = prefix_;
    prefix_ += part;
    keys(*this);
    prefix_ = outer;
  }

  Role role_;
  std::string prefix_;
};

std::string canonical(const Scene& scene, Role role) {
  Writer writer(role);
  Scene copy = scene;  // the table hands out references that can be written
  walk_scene(writer, copy);
  return std::move(writer.text);
}

bool placed_by_the_clip(const Scene& scene) {
  const bool lights = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return light.kind != LightKind::kSun &&
           (!light.position || (light.kind == LightKind::kArea ? !light.radius : !light.size));
  });
  const bool ground = scene.render.ground.show != GroundMode::kOff && !scene.render.ground.height;
  const bool range = std::any_of(scene.fields.begin(), scene.fields.end(), [](const Field& f) { return !f.range; });
  const auto open = [](const Body& b) { return b.data && !b.data->range; };
  const bool data = std::any_of(scene.soft.begin(), scene.soft.end(), open) ||
                    std::any_of(scene.cloth.begin(), scene.cloth.end(), open);
  return lights || ground || range || data || !scene.camera.position || !scene.camera.target;
}

}  // namespace

std::string canonical_physics(const Scene& scene) { return canonical(scene, Role::kPhysics); }

std::string canonical_picture(const Scene& scene) {
  std::string text = canonical(scene, Role::kPicture);
  if (placed_by_the_clip(scene)) text += "frames = " + std::to_string(scene.time.frames()) + "\n";
  return text;
}

}  // namespace softreel::assets
