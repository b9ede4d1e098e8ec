// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/blob_search.h"

#include <algorithm>
#include <utility>

namespace orbwatch::signals {
namespace {

constexpr int kLarge = 4;  // pixels from which on components are sorted by size

/// True if a pixel of the component reaches the threshold.
template <class T>
bool reaches(const Components& components, std::size_t component, const ImageView<const T>& values,
             double threshold) {
  bool found = false;
  components.for_each_span(component, [&](const Span& span) {
    const T* const row = values.row(span.y);
    for (int x = span.begin; x < span.end && !found; ++x) found = row[x] >= threshold;
  });
  return found;
}

}  // namespace

BlobSearch::BlobSearch(const RegionMask& mask, const RegionSettings& settings,
                       std::shared_ptr<SearchMemory> memory)
    : hot_spot_threshold_(settings.hot_spot_threshold),
      spatter_threshold_(settings.spatter_threshold.value_or(hot_spot_threshold_)),
      lowest_threshold_(std::min({hot_spot_threshold_, spatter_threshold_,
                                  settings.plume_threshold.value_or(hot_spot_threshold_)})),
      memory_(std::move(memory)) {
  memory_->lowest.reserve(mask);
  memory_->around.reserve(mask);
  memory_->blobs.reserve(mask);
  if (spatter_threshold_ > lowest_threshold_) memory_->sparks.reserve(mask);
  memory_->large.reserve(mask.pixels() / kLarge);
}

template <class T>
void BlobSearch::begin(const Planes<T>& planes, const RegionMask& mask) {
  memory_->lowest.find(planes.values, planes.validity, lowest_threshold_, mask);
}

/// Searches the largest components first: they have at least the pixels of the blobs in them, so
/// those of the many small ones mostly cannot matter any more.
template <class T>
std::optional<Blob> BlobSearch::follow(const Planes<T>& planes, const RegionGeometry& geometry,
                                       double passed, HotSpotTrack& track) {
  track.begin(passed);
  const Components& lowest = memory_->lowest;
  std::vector<std::size_t>& large = memory_->large;
  const auto consider = [&](std::size_t component) {
    if (!reaches(lowest, component, planes.values, hot_spot_threshold_)) return;
    memory_->blobs.find(planes.values, planes.validity, hot_spot_threshold_, lowest, component,
                        geometry);
    memory_->blobs.for_each_blob([&](const Blob& blob) { track.consider(blob); });
  };
  const auto is_settled = [&](int pixels) {
    constexpr double kRounding = 1 + 1e-9;
    return track.is_settled(pixels * kRounding * geometry.largest_solid_angle(),
                            pixels * kRounding * geometry.largest_area());
  };
  const auto pixels_of = [&](std::size_t component) { return lowest.pixels(component); };
  large.clear();
  const std::size_t runs = lowest.runs().size();
  for (std::size_t i = 0; i < runs; ++i) {
    if (pixels_of(i) >= kLarge) large.push_back(i);
  }
  std::ranges::make_heap(large, {}, pixels_of);
  while (!large.empty() && !is_settled(pixels_of(large.front()))) {
    consider(large.front());
    std::ranges::pop_heap(large, {}, pixels_of);
    large.pop_back();
  }
  if (large.empty() && !is_settled(kLarge - 1)) {
    for (std::size_t i = 0; i < runs; ++i) {
      if (pixels_of(i) > 0 && pixels_of(i) < kLarge) consider(i);
    }
  }
  return track.choose();
}

template <class T>
void BlobSearch::assign(const Planes<T>& planes, double threshold, int x, int y,
                        BlobPixels& pixels) {
  pixels.clear();
  const Components& lowest = memory_->lowest;
  const std::size_t component = lowest.at(x, y);
  if (component == Components::kNone) return;
  Components& around = memory_->around;
  around.find(planes.values, planes.validity, threshold, lowest, component);
  pixels.assign(around, around.at(x, y));
}

/// Measures the sparks that the tracker compares; the others are only counted.
template <class T>
void BlobSearch::add_sparks(const Planes<T>& planes, const RegionGeometry& geometry,
                            const BlobPixels& hot_spot, int x, int y, SpatterTracker& tracker) {
  const bool is_lowest = spatter_threshold_ <= lowest_threshold_;
  if (!is_lowest) {
    memory_->sparks.find(planes.values, planes.validity, spatter_threshold_, memory_->lowest);
  }
  const Components& sparks = is_lowest ? memory_->lowest : memory_->sparks;
  const std::size_t around = sparks.at(x, y);
  const auto is_spark = [&](std::size_t run) {
    const Span& first = sparks.runs()[run].span;
    return sparks.pixels(run) > 0 && run != around && !hot_spot.contains(first.begin, first.y);
  };
  std::size_t others = sparks.count() - (around == Components::kNone ? 0 : 1);
  if (spatter_threshold_ > hot_spot_threshold_ && !hot_spot.empty()) {  // it may hold several
    others = 0;
    for (std::size_t i = 0; i < sparks.runs().size(); ++i) others += is_spark(i) ? 1 : 0;
  }
  std::size_t measured = 0;
  for (std::size_t i = 0; measured < std::min(others, kMaxSparkParts); ++i) {
    if (!is_spark(i)) continue;
    ++measured;
    memory_->blobs.find(planes.values, planes.validity, spatter_threshold_, sparks, i, geometry);
    memory_->blobs.for_each_blob([&](const Blob& blob) { tracker.add(blob.moment); });
  }
  tracker.add_beyond(others - measured);
}

#define ORBWATCH_SEARCH_BLOBS(T)                                                                   \
  template void BlobSearch::begin(const Planes<T>&, const RegionMask&);                            \
  template std::optional<Blob> BlobSearch::follow(const Planes<T>&, const RegionGeometry&, double, \
                                                  HotSpotTrack&);                                  \
  template void BlobSearch::assign(const Planes<T>&, double, int, int, BlobPixels&);               \
  template void BlobSearch::add_sparks(const Planes<T>&, const RegionGeometry&, const BlobPixels&, \
                                       int, int, SpatterTracker&)
ORBWATCH_SEARCH_BLOBS(std::uint8_t);
ORBWATCH_SEARCH_BLOBS(std::uint16_t);

}  // namespace orbwatch::signals
