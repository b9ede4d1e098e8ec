// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/blob_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "proc/signals/signal_list.h"
#include "tests/proc/signals/hot_spot/scalar_level_set.h"
#include "tests/proc/signals/painted_region.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

/// Every bit of the blob as text, so that two NaNs are equal.
std::string text_of(const std::optional<Blob>& blob) {
  if (!blob) return "none";
  std::array<char, 400> text{};
  const Blob& b = *blob;
  std::snprintf(text.data(), text.size(), "%a %a %a %a %a %a %a %a, %d at %d %d, %d %d %d",
                b.solid_angle, b.moment.x, b.moment.y, b.moment.z, b.area, b.position.x,
                b.position.y, b.position.z, b.peak, b.peak_x, b.peak_y, b.first.y, b.first.begin,
                b.first.end);
  return text.data();
}

std::vector<std::array<int, 3>> list_of(std::span<const Span> spans) {
  std::vector<std::array<int, 3>> list;
  for (const Span& span : spans) list.push_back({span.y, span.begin, span.end});
  return list;
}

/// A random region of a random view and random thresholds in it.
template <class T>
class Search {
 public:
  explicit Search(unsigned seed)
      : random_(seed),
        painted_({chance(0.8) ? optics::ViewKind::Perspective : optics::ViewKind::Equirectangular,
                  {between(-90, 90), between(-80, -20), between(0, 90)},
                  std::nullopt,
                  {},
                  1 + static_cast<int>(random_() % 300),
                  1 + static_cast<int>(random_() % 120)}),
        counts_(painted_.values.size()),
        scene_(chance(0.7) ? floor_scene() : RegionScene{}),
        mask_(RegionMask::make(painted_.view, {}, some_holes()).value()),
        geometry_(painted_.view, scene_, mask_),
        settings_(random_settings()),
        search_(mask_, settings_),
        track_(settings_.hot_spot_limits),
        scalar_track_(settings_.hot_spot_limits),
        pixels_(mask_) {}

  /// Paints the next frame set and compares the results for it.
  void compare() {
    paint();
    const double passed = chance(0.1) ? 0.5 : 0.02;
    now_ += passed;
    const ImageView<const T> values{counts_.data(), painted_.view.width(), painted_.view.height(),
                                    1, painted_.view.width()};
    const auto seen = painted_.seen();
    const typename BlobSearch::template Planes<T> planes{values, seen};
    search_.begin(planes, mask_);
    const auto blob = search_.follow(planes, geometry_, passed, track_);

    const ScalarLevelSet hot(values, seen, settings_.hot_spot_threshold, mask_, geometry_);
    scalar_track_.begin(passed);
    for (std::size_t i = 0; i < hot.size(); ++i) {
      if (hot.is_whole(i)) scalar_track_.consider(hot.blob(i));
    }
    ASSERT_EQ(text_of(blob), text_of(scalar_track_.choose()));
    ASSERT_EQ(track_.confidence(), scalar_track_.confidence());
    hot_spots_ += blob ? 1 : 0;

    pixels_.clear();
    if (blob) {
      peak_x_ = blob->peak_x;
      peak_y_ = blob->peak_y;
      for (const auto& threshold :
           {settings_.plume_threshold, std::optional(settings_.hot_spot_threshold)}) {
        if (!threshold) continue;
        search_.assign(planes, *threshold, peak_x_, peak_y_, pixels_);
        const ScalarLevelSet level(values, seen, *threshold, mask_, geometry_);
        ASSERT_EQ(list_of(pixels_.spans()),
                  list_of(level.spans_of(*level.blob_at(peak_x_, peak_y_))));
      }
    }
    if (settings_.spatter_threshold) compare_sparks(planes);
  }

  int hot_spots() const { return hot_spots_; }
  std::uint64_t sparks() const { return sparks_; }
  std::uint64_t untracked() const { return tracker_.untracked(); }

 private:
  double between(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  bool chance(double share) { return between(0, 1) < share; }

  RegionMask::Sees some_holes() {
    if (chance(0.5)) return nullptr;
    return [](const Vec3& d) { return std::fmod(std::abs(d.x) * 57, 1.0) > 0.03; };
  }

  RegionSettings random_settings() {
    constexpr double kScale = std::numeric_limits<T>::max();
    RegionSettings settings;
    settings.hot_spot_threshold = std::floor(between(0.3, 0.6) * kScale) + (chance(0.5) ? 0.5 : 0);
    if (chance(0.5)) settings.plume_threshold = between(0.2, 0.29) * kScale;
    if (chance(0.9)) settings.spatter_threshold = between(0.15, 0.7) * kScale;
    if (chance(0.1)) settings.spatter_threshold = settings.hot_spot_threshold;
    if (!scene_.proxy.is_far()) {
      if (chance(0.4)) settings.hot_spot_limits.min_area = between(1, 3000);
      if (chance(0.4)) settings.hot_spot_limits.max_speed = between(10, 5000);
    }
    return settings;
  }

  /// Paints a cold region, with a hot spot or without, and noise of any density; sometimes all
  /// equally hot.
  void paint() {
    constexpr double kScale = std::numeric_limits<T>::max();
    const int width = painted_.view.width(), height = painted_.view.height();
    const double u = between(0, width), v = between(0, height);
    const double radius = chance(0.5) ? between(1, 30) : 0;
    const double density = chance(0.3) ? 0 : std::exp2(between(-10, -0.5));
    const double unseen = chance(0.5) ? 0 : 0.02;
    const bool is_tied = chance(0.5);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double count = between(0, 0.1) * kScale;
        if (chance(density)) count = kScale * (is_tied ? 0.75 : between(0.1, 1));
        const double square = ((x - u) * (x - u) + (y - v) * (y - v)) / (radius * radius);
        if (radius > 0) count = std::max(count, kScale * std::exp(-square));
        counts_[static_cast<std::size_t>(y * width + x)] = static_cast<T>(count);
        painted_.validity_at(x, y) = chance(unseen) ? 1 : 255;
      }
    }
  }

  void compare_sparks(const typename BlobSearch::template Planes<T>& planes) {
    const ScalarLevelSet level(planes.values, planes.validity, *settings_.spatter_threshold, mask_,
                               geometry_);
    const auto around = level.blob_at(peak_x_, peak_y_);
    for (std::size_t i = 0; i < level.size(); ++i) {
      const Blob& blob = level.blob(i);
      if (!level.is_whole(i) || around == i) continue;
      if (pixels_.contains(blob.peak_x, blob.peak_y)) continue;
      scalar_sparks_.add(blob.moment);
      ++sparks_;
    }
    search_.add_sparks(planes, geometry_, pixels_, peak_x_, peak_y_, tracker_);
    Signals found, expected;
    for (const auto& [tracker, signals] :
         {std::pair(&tracker_, &found), {&scalar_sparks_, &expected}}) {
      tracker->update(now_, std::nullopt);
      tracker->write(*signals);
    }
    for (const SignalInfo& signal : kSignals) {
      if (!is_valid(expected.*signal.member)) continue;
      ASSERT_EQ(found.*signal.member, expected.*signal.member) << signal.name;
    }
    ASSERT_EQ(tracker_.untracked(), scalar_sparks_.untracked());
    ASSERT_EQ(tracker_.comparisons(), scalar_sparks_.comparisons());
  }

  std::mt19937 random_;
  PaintedView painted_;
  std::vector<T> counts_;
  RegionScene scene_;
  RegionMask mask_;
  RegionGeometry geometry_;
  RegionSettings settings_;
  BlobSearch search_;
  HotSpotTrack track_, scalar_track_;
  SpatterTracker tracker_, scalar_sparks_;
  BlobPixels pixels_;
  int peak_x_ = -1, peak_y_ = -1;
  double now_ = 0;
  int hot_spots_ = 0;
  std::uint64_t sparks_ = 0;
};

template <class T>
class BlobSearchOf : public testing::Test {};
using CountTypes = testing::Types<std::uint8_t, std::uint16_t>;
TYPED_TEST_SUITE(BlobSearchOf, CountTypes);

TYPED_TEST(BlobSearchOf, RandomRegionsFindsWhatTheScalarSpecificationFinds) {
  int hot_spots = 0;
  std::uint64_t sparks = 0, untracked = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Search<TypeParam> search(seed);
    for (int frame_set = 0; frame_set < 6; ++frame_set) {
      search.compare();
      if (this->HasFatalFailure()) return;
    }
    hot_spots += search.hot_spots();
    sparks += search.sparks();
    untracked += search.untracked();
  }
  EXPECT_GT(hot_spots, 300);
  EXPECT_GT(sparks, 10000U);
  EXPECT_GT(untracked, 1000U) << "no noise beyond what is compared";
}

}  // namespace
}  // namespace orbwatch::signals
