#include "proc/signals/hot_spot.h"

#include <algorithm>
#include <utility>

#include "proc/image/validity.h"

namespace orbwatch::signals {

using optics::Vec3;

HotSpotDetector::HotSpotDetector(const optics::ViewProjection& view)
    : width_(view.width()), height_(view.height()) {
  pixels_.reserve(static_cast<std::size_t>(width_) * height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      // Where the projection ends there is nothing to measure: such pixels are never Seen.
      const Vec3 d = view.direction(x, y).value_or(Vec3{});
      pixels_.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                         static_cast<float>(view.solid_angle(x, y))});
    }
  }
  // A row has at most every second pixel as a run, so this is the most there can ever be.
  const std::size_t runs_per_row = static_cast<std::size_t>(width_ + 1) / 2;
  regions_.reserve(runs_per_row * height_);
  above_.reserve(runs_per_row);
  current_.reserve(runs_per_row);
}

HotSpot HotSpotDetector::measure(const ImageView<const std::uint8_t>& values,
                                 const ImageView<const std::uint8_t>& validity, double threshold) {
  return measure_any(values, validity, threshold);
}

HotSpot HotSpotDetector::measure(const ImageView<const std::uint16_t>& values,
                                 const ImageView<const std::uint8_t>& validity, double threshold) {
  return measure_any(values, validity, threshold);
}

template <class T>
HotSpot HotSpotDetector::measure_any(const ImageView<const T>& values,
                                     const ImageView<const std::uint8_t>& validity,
                                     double threshold) {
  regions_.clear();
  above_.clear();
  for (int y = 0; y < height_; ++y) {
    current_.clear();
    collect_runs(values, validity, threshold, y);
    join_with_row_above();
    std::swap(above_, current_);
  }
  const auto largest = std::max_element(
      regions_.begin(), regions_.end(),
      [](const Region& a, const Region& b) { return a.solid_angle < b.solid_angle; });
  if (largest == regions_.end() || !(largest->solid_angle > 0)) return {};
  return {true, optics::normalized(largest->moment), largest->solid_angle, largest->peak,
          largest->weighted / largest->solid_angle};
}

template <class T>
void HotSpotDetector::collect_runs(const ImageView<const T>& values,
                                   const ImageView<const std::uint8_t>& validity, double threshold,
                                   int y) {
  const T* value = values.row(y);
  const std::uint8_t* seen = validity.row(y);
  const PixelGeometry* pixel = pixels_.data() + static_cast<std::size_t>(y) * width_;
  const auto hot = [&](int x) {
    return value[x] >= threshold && seen[x] == static_cast<std::uint8_t>(Validity::Seen);
  };
  for (int x = 0; x < width_; ++x) {
    if (!hot(x)) continue;
    const auto index = static_cast<std::int32_t>(regions_.size());
    Region region{{}, 0, 0, 0, index};
    const int begin = x;
    for (; x < width_ && hot(x); ++x) {
      const double omega = pixel[x].solid_angle;
      // Counting from just below the threshold keeps a region of equal values a plain centroid.
      const double weight = omega * (value[x] - threshold + 1);
      region.moment = region.moment + Vec3{pixel[x].x, pixel[x].y, pixel[x].z} * weight;
      region.solid_angle += omega;
      region.weighted += omega * value[x];
      region.peak = std::max<double>(region.peak, value[x]);
    }
    current_.push_back({begin, x, index});
    regions_.push_back(region);
  }
}

void HotSpotDetector::join_with_row_above() {
  std::size_t first = 0;
  for (const Run& run : current_) {
    // Diagonal neighbours count: runs touch when they overlap by one pixel more on either side.
    while (first < above_.size() && above_[first].end < run.begin) ++first;
    for (std::size_t i = first; i < above_.size() && above_[i].begin <= run.end; ++i) {
      const std::int32_t a = root(above_[i].region), b = root(run.region);
      if (a == b) continue;
      Region& kept = regions_[std::min(a, b)];
      Region& joined = regions_[std::max(a, b)];
      kept.moment = kept.moment + joined.moment;
      kept.solid_angle += joined.solid_angle;
      kept.weighted += joined.weighted;
      kept.peak = std::max(kept.peak, joined.peak);
      joined.parent = kept.parent;
      joined.solid_angle = 0;
    }
  }
}

std::int32_t HotSpotDetector::root(std::int32_t region) {
  while (regions_[region].parent != region) {
    regions_[region].parent = regions_[regions_[region].parent].parent;
    region = regions_[region].parent;
  }
  return region;
}

}  // namespace orbwatch::signals
