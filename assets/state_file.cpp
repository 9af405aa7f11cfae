#include "assets/state_file.h"

#include "assets/atomic_file.h"
#include "assets/blob.h"
#include "assets/content_hash.h"
#include "assets/error.h"

namespace softreel::assets {
namespace {

constexpr std::string_view kMagic = "softreel state 1\n";

}  // namespace

void write_state(const std::filesystem::path& file, const std::string& hash, const StateRecord& record, bool sync) {
  BlobWriter payload;
  payload.text(hash);
  payload.value<std::uint64_t>(record.arrays.size());
  for (const auto& [name, values] : record.arrays) {
    payload.text(name);
    payload.array(values);
  }
  payload.value<std::uint64_t>(record.scalars.size());
  for (const auto& [name, value] : record.scalars) {
    payload.text(name);
    payload.value(value);
  }
  AtomicFile out(file);
  out.write(kMagic);
  const std::uint64_t checksum = checksum64(payload.bytes);
  out.write(&checksum, sizeof checksum);
  out.write(payload.bytes);
  out.commit(sync);
}

std::optional<StateRecord> read_state(const std::filesystem::path& file, const std::string& hash) {
  try {
    const std::string bytes = read_file(file);
    const std::size_t header = kMagic.size() + sizeof(std::uint64_t);
    if (bytes.size() < header || !bytes.starts_with(kMagic)) return std::nullopt;
    const std::string_view payload = std::string_view(bytes).substr(header);
    if (BlobReader(std::string_view(bytes).substr(kMagic.size())).value<std::uint64_t>() != checksum64(payload)) {
      return std::nullopt;
    }
    BlobReader in(payload);
    if (in.text() != hash) return std::nullopt;
    StateRecord record;
    for (auto n = in.value<std::uint64_t>(); n > 0; --n) {
      std::string name = in.text();
      record.arrays[std::move(name)] = in.array<double>();
    }
    for (auto n = in.value<std::uint64_t>(); n > 0; --n) {
      std::string name = in.text();
      record.scalars[std::move(name)] = in.value<double>();
    }
    if (!in.at_end()) return std::nullopt;
    return record;
  } catch (const UserError&) {  // missing or unreadable: it will be made again
    return std::nullopt;
  } catch (const BrokenBlob&) {
    return std::nullopt;
  }
}

}  // namespace softreel::assets
