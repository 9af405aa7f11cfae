#include <cstring>
#include <limits>

#include "assets/state_file.h"
#include "tests/assets/support.h"

using namespace softreel;

namespace {

assets::StateRecord record() {
  using Limits = std::numeric_limits<double>;
  assets::StateRecord r;
  r.arrays["x"] = {0.1, -0.0, Limits::denorm_min(), Limits::max(), Limits::quiet_NaN(), -Limits::infinity()};
  r.arrays["history/0"] = {};
  r.arrays["v"] = std::vector<double>(1000, 1.0 / 3);
  r.scalars["t"] = 0.1 + 0.2;
  r.scalars["contact/stiffness"] = -0.0;
  return r;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), 8 * a.size()) == 0);
}

}  // namespace

TEST_CASE("A state comes back bit by bit") {
  test::TempFolder folder;
  assets::write_state(folder / "frame.state", "hash 7", record());
  const auto read = assets::read_state(folder / "frame.state", "hash 7");
  REQUIRE(read);
  REQUIRE(read->arrays.size() == 3);
  for (const auto& [name, values] : record().arrays) CHECK(same_bits(read->arrays.at(name), values));
  for (const auto& [name, value] : record().scalars) CHECK(same_bits({read->scalars.at(name)}, {value}));
  CHECK(folder.files() == 1);
}

TEST_CASE("A state that is missing, of another hash, cut or changed anywhere is nothing") {
  test::TempFolder folder;
  const auto file = folder / "frame.state";
  CHECK_FALSE(assets::read_state(file, "hash"));
  CHECK_FALSE(assets::read_state(folder.path(), "hash"));
  assets::StateRecord small;
  small.arrays["x"] = {1, 2, 3};
  small.scalars["t"] = 4;
  assets::write_state(file, "hash", small);
  CHECK_FALSE(assets::read_state(file, "other"));
  const std::string good = test::slurp(file);
  for (std::size_t length = 0; length < good.size(); ++length) {
    folder.write("frame.state", good.substr(0, length));
    CHECK_FALSE(assets::read_state(file, "hash"));
  }
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    folder.write("frame.state", bad);
    CHECK_FALSE(assets::read_state(file, "hash"));
  }
  folder.write("frame.state", good + "x");
  CHECK_FALSE(assets::read_state(file, "hash"));
  folder.write("frame.state", good);
  CHECK(assets::read_state(file, "hash"));
}
