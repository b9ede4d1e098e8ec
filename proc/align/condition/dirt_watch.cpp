// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/dirt_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "proc/align/condition/ball_crop.h"
#include "proc/align/condition/ball_raster.h"
#include "proc/align/condition/dirt_area.h"

namespace orbwatch::align {
namespace {

constexpr std::size_t kFewest = (DirtWatch::kLooks + 1) / 2;  // looks that a figure needs
constexpr double kStale = 1.5;  // windows after which a look is dropped
constexpr double kBallArea = std::numbers::pi * kRasterRadius * kRasterRadius;

/// One pixel's values in those looks in which it was judged.
class Values {
 public:
  void add(std::uint8_t value) { values_[count_++] = value; }
  std::size_t count() const { return count_; }
  std::uint8_t median() {
    const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
    std::nth_element(values_.begin(), middle,
                     values_.begin() + static_cast<std::ptrdiff_t>(count_));
    return *middle;
  }
  std::uint8_t highest() const {
    return *std::max_element(values_.begin(),
                             values_.begin() + static_cast<std::ptrdiff_t>(count_));
  }

 private:
  std::array<std::uint8_t, DirtWatch::kLooks> values_{};
  std::size_t count_ = 0;
};

std::string progress(std::size_t looks, const std::string& trouble) {
  return std::to_string(looks) + " of " + std::to_string(kFewest) + " pictures so far" +
         (trouble.empty() ? "" : "; the latest: " + trouble);
}

/// Calls set(place, values) for each place that was judged in `map` in at least half of the looks.
template <class Looks, class Set>
void for_judged(const Looks& looks, cv::Mat SmallMarks::*map, const Set& set) {
  for (int v = 0; v < kRasterSide; ++v) {
    for (int u = 0; u < kRasterSide; ++u) {
      Values values;
      for (const auto& look : looks) {
        if (look.marks.judged.template at<std::uint8_t>(v, u) != 0) {
          values.add((look.marks.*map).template at<std::uint8_t>(v, u));
        }
      }
      if (2 * values.count() >= looks.size()) set(cv::Point(u, v), values);
    }
  }
}

/// Medians of all looks.
template <class Looks>
SmallMarks usual_marks(const Looks& looks) {
  SmallMarks usual = SmallMarks::none();
  for (const auto map : SmallMarks::maps()) {
    if (map == &SmallMarks::judged) continue;
    for_judged(looks, map, [&](const cv::Point& place, Values& values) {
      (usual.*map).template at<std::uint8_t>(place) = values.median();
      usual.judged.at<std::uint8_t>(place) = 255;
    });
  }
  return usual;
}

}  // namespace

Result<DirtWatch> DirtWatch::make(int width, int height, const optics::Outline& outline,
                                  const DirtSettings& settings) {
  const auto checked = optics::check_ellipse(outline).and_then(
      [&] { return optics::check_outline(outline, width, height); });
  if (!checked) return tl::unexpected(checked.error());
  if (!(settings.window > 0 && std::isfinite(settings.window))) {
    return fail("the window of dirt is " + std::to_string(settings.window) + " s; it must be > 0");
  }
  if (!(settings.widest >= 0.03 && settings.widest <= 0.5)) {
    return fail("the widest spot of dirt is " + std::to_string(settings.widest) +
                " ball radii; it must be 0.03 to 0.5");
  }
  return DirtWatch({width, height}, outline, settings);
}

Result<> DirtWatch::use(const DirtReference& reference) {
  if (auto checked = check_reference(reference); !checked) return checked;
  reference_ = reference;
  dirt_ = judge();
  return {};
}

void DirtWatch::observe(const Picture& picture, double now) {
  const double pause = settings_.window / static_cast<double>(kLooks);
  if (last_look_ && now < *last_look_ + pause) return;
  last_look_ = now;
  forget(now - kStale * settings_.window);
  if (auto marks = look(picture)) {
    trouble_.clear();
    if (looks_.size() == kLooks) looks_.pop_front();
    looks_.push_back({now, *std::move(marks)});
  } else {
    trouble_ = marks.error().message;
  }
  dirt_ = judge();
}

void DirtWatch::forget() {
  reference_.reset();
  looks_.clear();
  last_look_.reset();
  trouble_.clear();
  dirt_ = fail("no picture of the ball so far");
}

Result<SmallMarks> DirtWatch::look(const Picture& picture) const {
  if (cv::Size(picture.width, picture.height) != size_) {
    return fail("the picture is " + std::to_string(picture.width) + "x" +
                std::to_string(picture.height) + " instead of " + std::to_string(size_.width) +
                "x" + std::to_string(size_.height));
  }
  auto crop = crop_ball(picture, outline_);
  if (!crop) return tl::unexpected(crop.error());
  // An odd width has a middle.
  const int widest = 2 * static_cast<int>(settings_.widest * kRasterRadius / 2) + 1;
  return small_marks(raster_of(*std::move(crop)), widest);
}

void DirtWatch::forget(double before) {
  while (!looks_.empty() && looks_.front().time < before) looks_.pop_front();
}

Result<Dirt> DirtWatch::judge() const {
  if (looks_.size() < kFewest) return fail(progress(looks_.size(), trouble_));
  if (!reference_) return fail("no picture of the clean ball has been learnt");
  const SmallMarks usual = usual_marks(looks_);
  const DirtArea area = dirt_area(usual, *reference_);
  Dirt dirt;
  dirt.judged = std::min(area.judged / kBallArea, 1.0);
  if (dirt.judged < 0.1) return fail("less than a tenth of the ball is lit as it was when clean");
  dirt.contamination = static_cast<double>(area.dirty) / area.judged;
  dirt.largest_spot = 2 * std::sqrt(area.largest / std::numbers::pi) / kRasterRadius;
  dirt.dulled = dulled_share(usual, *reference_);
  return dirt;
}

Result<DirtReference> DirtWatch::learnt() const {
  if (looks_.size() < kFewest) return fail(progress(looks_.size(), trouble_));
  DirtReference reference = usual_marks(looks_);
  for (const auto map : {&SmallMarks::dark, &SmallMarks::bright}) {
    for_judged(looks_, map, [&](const cv::Point& place, const Values& values) {
      (reference.*map).at<std::uint8_t>(place) = values.highest();
    });
  }
  return reference;
}

}  // namespace orbwatch::align
