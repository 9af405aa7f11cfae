#include "assets/surface_diagnosis.h"
#include "assets/surface_import.h"
#include "tests/assets/support.h"

using namespace softreel;

namespace {

template <class T>
std::string raw(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

// Properties of a record of FBX 7.4: a letter for the type, then the value.
std::string typed(char type, const std::string& value) { return std::string(1, type).append(value); }
std::string property(std::int32_t v) { return typed('I', raw(v)); }
std::string property(std::int64_t v) { return typed('L', raw(v)); }
std::string property(const std::string& v) { return typed('S', raw(static_cast<std::uint32_t>(v.size())).append(v)); }
template <class T>
std::string array(char type, const std::vector<T>& values) {
  std::string bytes(1, type);
  bytes += raw(static_cast<std::uint32_t>(values.size())) + raw(std::uint32_t{0}) +
           raw(static_cast<std::uint32_t>(values.size() * sizeof(T)));
  for (const T v : values) bytes += raw(v);
  return bytes;
}

struct Record {
  std::string name;
  std::vector<std::string> properties;
  std::vector<Record> children;

  std::string bytes(std::size_t at) const {
    std::string values, inside;
    for (const std::string& p : properties) values += p;
    std::size_t end = at + 13 + name.size() + values.size();
    for (const Record& child : children) inside += child.bytes(end + inside.size());
    if (!children.empty()) inside += std::string(13, '\0');
    end += inside.size();
    return raw(static_cast<std::uint32_t>(end)) + raw(static_cast<std::uint32_t>(properties.size())) +
           raw(static_cast<std::uint32_t>(values.size())) + raw(static_cast<std::uint8_t>(name.size())) + name +
           values + inside;
  }
};

std::string class_name(const std::string& name, const std::string& type) {
  return name + std::string("\0\x01", 2) + type;
}

}  // namespace

TEST_CASE("A binary FBX is read") {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<std::int32_t> faces = {0, 2, -2, 0, 1, -4,
                                           0, 3, -3, 1, 2, -4};  // the last corner of each as -1 - v
  const std::int64_t geometry = 100, model = 200, root = 0;
  const std::vector<Record> records = {
      {"FBXHeaderExtension", {}, {{"FBXVersion", {property(7400)}, {}}}},
      {"Definitions", {}, {{"Version", {property(100)}, {}}}},
      {"Objects",
       {},
       {{"Geometry",
         {property(geometry), property(class_name("g", "Geometry")), property(std::string("Mesh"))},
         {{"Vertices", {array('d', points)}, {}}, {"PolygonVertexIndex", {array('i', faces)}, {}}}},
        {"Model",
         {property(model), property(class_name("m", "Model")), property(std::string("Mesh"))},
         {{"Version", {property(232)}, {}}}}}},
      {"Connections",
       {},
       {{"C", {property(std::string("OO")), property(model), property(root)}, {}},
        {"C", {property(std::string("OO")), property(geometry), property(model)}, {}}}}};
  std::string file = std::string("Kaydara FBX Binary  \0\x1a\0", 23) + raw(std::uint32_t{7400});
  for (const Record& record : records) file += record.bytes(file.size());
  file += std::string(13 + 160, '\0');
  test::TempFolder folder;
  const auto surface = assets::import_surface(folder.write("t.fbx", file));
  CHECK(surface.welded.vertices.size() == 4);
  CHECK(assets::diagnose_surface(surface.welded).volume == doctest::Approx(1.0 / 6));
  CHECK_FALSE(surface.parts[0].base_color);
}
