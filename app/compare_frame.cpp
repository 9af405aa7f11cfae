#include "app/compare_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <tuple>

#include "assets/content_hash.h"
#include "assets/error.h"
#include "render/difference_picture.h"
#include "render/image_io.h"

namespace softreel::app {
namespace {

namespace fs = std::filesystem;

/// Rec. 709 luma in 1/64 levels; the weights sum to 64.
int luma64(const std::uint8_t* p) { return 14 * p[0] + 45 * p[1] + 5 * p[2]; }

FrameSide side_of(const render::Image& image) {
  FrameSide side{image.width, image.height, {}, {}};
  assets::ContentHasher hasher;
  hasher.add(image.width).add(image.height).add_bytes(image.rgba.data(), image.rgba.size());
  side.pixel_hash = hasher.hex();
  std::array<double, kThumbnailWidth * kThumbnailHeight> sums{}, counts{};
  for (int y = 0; y < image.height; ++y) {
    const int row = y * kThumbnailHeight / image.height;
    for (int block = 0; block < kThumbnailWidth; ++block) {
      const int first = (block * image.width + kThumbnailWidth - 1) / kThumbnailWidth;
      const int end = ((block + 1) * image.width + kThumbnailWidth - 1) / kThumbnailWidth;
      int sum = 0;
      for (int x = first; x < end; ++x) sum += luma64(image.pixel(x, y));
      const auto i = static_cast<std::size_t>(row * kThumbnailWidth + block);
      sums[i] += sum;
      counts[i] += end - first;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    side.thumbnail[i] = counts[i] > 0 ? static_cast<float>(sums[i] / (64 * counts[i])) : 0.0f;
  return side;
}

struct Loaded {
  std::vector<std::byte> bytes;
  render::Image image;
  FrameSide side;
};

void decode(Loaded& loaded, const fs::path& file) {
  loaded.image = render::load_image(loaded.bytes, file.string());
  loaded.side = side_of(loaded.image);
}

std::vector<std::int16_t> change_between(const render::Image& reference, const render::Image& actual) {
  std::vector<std::int16_t> change(reference.pixel_count());
  for (std::size_t i = 0; i < change.size(); ++i)
    change[i] = static_cast<std::int16_t>(luma64(actual.rgba.data() + 4 * i) - luma64(reference.rgba.data() + 4 * i));
  return change;
}

void cover_masks(const Loaded& reference, Loaded& actual, const FrameRule& rule, const fs::path& ids,
                 FrameResult& result) {
  result.masked_pixels = render::cover(reference.image, actual.image, rule.rectangles);
  if (rule.ids.empty()) return;
  const render::IdPicture picture = render::load_ids(ids);
  if (picture.width != reference.image.width || picture.height != reference.image.height)
    throw assets::UserError(assets::ErrorKind::kInput, ids.string(),
                            fmt::format("the ids are {} x {} pixels, the picture {} x {}", picture.width,
                                        picture.height, reference.image.width, reference.image.height));
  result.masked_pixels += render::cover(reference.image, actual.image, picture.ids, rule.ids);
}

void compare_loaded(const Loaded& reference, const Loaded& actual, const FrameRule& rule, double pixels_per_degree,
                    int threads, FrameWork& work) {
  FrameResult& r = work.result;
  r.difference = render::compare(reference.image, actual.image);
  if (!r.difference.same_size) return;
  const bool masked = !rule.rectangles.empty() || !rule.ids.empty();
  if (render::has_finer_levels(reference.bytes) || render::has_finer_levels(actual.bytes)) {
    r.note = "16 bits a channel: the upper 8 are compared, finer differences count as one level";
    if (!masked)
      render::add_finer_differences(render::load_fine(reference.bytes, r.name), render::load_fine(actual.bytes, r.name),
                                    r.difference);
  }
  if (r.difference.differing_pixels == 0) return;
  work.change = change_between(reference.image, actual.image);
  if (rule.tolerance.rung == render::Rung::kPerceptual)
    r.flip = render::figures_of(render::flip(reference.image, actual.image, {pixels_per_degree}, threads));
}

}  // namespace

FrameWork compare_frame(const FramePair& pair, const FrameRule& rule, const fs::path& ids, double pixels_per_degree,
                        int threads) {
  FrameWork work;
  FrameResult& r = work.result;
  r.name = pair.name;
  r.number = pair.number;
  r.note = rule.why;
  if (rule.skip) {
    r.state = FrameState::kSkipped;
    r.good = true;
    return work;
  }
  if (pair.reference.empty() || pair.actual.empty()) {
    r.state = pair.reference.empty() ? FrameState::kExtra : FrameState::kMissing;
    Loaded only;
    const fs::path& file = pair.reference.empty() ? pair.actual : pair.reference;
    only.bytes = render::read_picture_file(file);
    decode(only, file);
    (pair.reference.empty() ? r.actual : r.reference) = only.side;
    return work;
  }
  Loaded reference, actual;
  reference.bytes = render::read_picture_file(pair.reference);
  actual.bytes = render::read_picture_file(pair.actual);
  if (reference.bytes == actual.bytes) {
    decode(reference, pair.reference);  // the same bytes of something that is no picture are no success
    r.reference = r.actual = reference.side;
    r.difference.same_size = true;
    r.difference.pixels = reference.image.pixel_count();
    r.judgement = {true, render::Rung::kBytes, {}};
    r.good = true;
    return work;
  }
  if (threads > 1) {
    auto other = std::async(std::launch::async, [&] { decode(actual, pair.actual); });
    decode(reference, pair.reference);
    other.get();
  } else {
    decode(reference, pair.reference);
    decode(actual, pair.actual);
  }
  r.reference = reference.side;
  r.actual = actual.side;
  if (reference.image.width == actual.image.width && reference.image.height == actual.image.height)
    cover_masks(reference, actual, rule, ids, r);
  compare_loaded(reference, actual, rule, pixels_per_degree, threads, work);
  r.judgement = render::judge(r.difference, false, r.flip ? &*r.flip : nullptr, rule.tolerance);
  r.good = r.judgement.good;
  return work;
}

render::Image picture_of_difference(const FramePair& pair, const FrameRule& rule, const fs::path& ids) {
  Loaded reference, actual;
  reference.image = render::load_image(pair.reference);
  actual.image = render::load_image(pair.actual);
  FrameResult ignored;
  if (reference.image.width == actual.image.width && reference.image.height == actual.image.height)
    cover_masks(reference, actual, rule, ids, ignored);
  return render::difference_picture(reference.image, actual.image);
}

fs::path ids_of(const CompareRules& rules, const FrameRule& rule, const std::string& name) {
  if (rule.ids.empty()) return {};
  std::error_code ignored;
  const fs::path ids = rules.ids();
  if (!fs::is_directory(ids, ignored)) return ids;
  constexpr std::string_view kFrame = "frame_";  // as `render` names them: frame_0001.png, id_0001.png
  if (name.starts_with(kFrame))
    if (const fs::path beside = ids / ("id_" + name.substr(kFrame.size())); fs::exists(beside, ignored)) return beside;
  return ids / name;
}

double flicker_between(const std::vector<std::int16_t>& a, const std::vector<std::int16_t>& b) {
  if (a.empty() && b.empty()) return 0;
  if (!a.empty() && !b.empty() && a.size() != b.size()) return 0;
  const std::vector<std::int16_t>& some = a.empty() ? b : a;
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < some.size(); ++i) sum += std::abs((a.empty() ? 0 : a[i]) - (b.empty() ? 0 : b[i]));
  return static_cast<double>(sum) / (64.0 * static_cast<double>(some.size()));
}

bool is_worse(const FrameResult& a, const FrameResult& b) {
  const auto key = [](const FrameResult& r) {
    const bool sizes = r.state == FrameState::kCompared && !r.difference.same_size;
    return std::tuple(!r.good, r.state == FrameState::kMissing || r.state == FrameState::kExtra, sizes,
                      r.flip ? r.flip->mean : 0.0, r.difference.mean_levels, r.difference.max_levels,
                      r.difference.differing_pixels);
  };
  return key(a) > key(b);
}

}  // namespace softreel::app
