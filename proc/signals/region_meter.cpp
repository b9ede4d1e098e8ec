#include "proc/signals/region_meter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "proc/optics/vec.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

Result<> check(const std::string& name, double value, double full_scale) {
  if (value > 0 && value <= full_scale) return {};
  return fail("region: the " + name + " is " + std::to_string(value) +
              " counts; it must be above 0 and at most full scale, " + std::to_string(full_scale));
}

Result<> check(const HotSpotLimits& limits) {
  if (!(limits.min_area >= 0 && std::isfinite(limits.min_area))) {
    return fail("region: the hot spot's least area is " + std::to_string(limits.min_area) +
                " mm2; it must be 0 or more");
  }
  if (limits.max_speed > 0) return {};
  return fail("region: the hot spot's highest speed is " + std::to_string(limits.max_speed) +
              " mm/s; it must be above 0");
}

Result<> check(const RegionSettings& s) {
  if (!(s.full_scale > 0 && s.full_scale <= 65535)) {
    return fail("region: full scale is " + std::to_string(s.full_scale) +
                " counts; it must be above 0 and at most 65535");
  }
  auto checked = check("hot spot threshold", s.hot_spot_threshold, s.full_scale);
  if (checked && s.plume_threshold)
    checked = check("plume threshold", *s.plume_threshold, s.full_scale);
  if (checked && s.spatter_threshold) {
    checked = check("spatter threshold", *s.spatter_threshold, s.full_scale);
  }
  if (!checked) return checked;
  if (s.plume_threshold && *s.plume_threshold >= s.hot_spot_threshold) {
    return fail("region: the plume threshold must be below the hot spot's");
  }
  if (s.width_set_point && !(*s.width_set_point > 0 && std::isfinite(*s.width_set_point))) {
    return fail("region: the width's set-point must be above 0 mm");
  }
  return check(s.hot_spot_limits);
}

/// The full axis of the ellipse whose variance along it is `variance`.
double axis_of(double variance) { return 4 * std::sqrt(variance); }

/// The same on the unit sphere, degrees.
double angle_of(double variance) {
  return optics::degrees(2 * std::asin(std::min(1.0, 2 * std::sqrt(variance))));
}

/// Of an axis, degrees in (-90, 90]; not valid when the ellipse is too round to have one.
double orientation(const PrincipalAxes& axes, double right, double up) {
  constexpr double kRound = 1.05;  // long axis / short axis
  if (axes.largest <= kRound * kRound * axes.second) return kNotValid;
  const double sense = right < 0 || (right == 0 && up < 0) ? -1 : 1;
  return optics::degrees(std::atan2(sense * up, sense * right));
}

void write_angles(const HotSpot& spot, Signals& signals) {
  const Vec3& d = spot.direction;
  signals.hot_spot_yaw = optics::degrees(std::atan2(d.x, d.y));
  signals.hot_spot_pitch = optics::degrees(std::atan2(d.z, std::hypot(d.x, d.y)));
  signals.hot_spot_length_angle = angle_of(spot.angular.largest);
  signals.hot_spot_width_angle = angle_of(spot.angular.second);
  const double level = std::hypot(d.x, d.y);
  const Vec3 right = level > 0 ? Vec3{d.y / level, -d.x / level, 0} : Vec3{1, 0, 0};
  const Vec3& axis = spot.angular.axis;
  signals.hot_spot_orientation = orientation(spot.angular, optics::dot(axis, right),
                                             optics::dot(axis, optics::cross(right, d)));
}

}  // namespace

Result<RegionMeter> RegionMeter::make(const optics::ViewProjection& view, const RegionScene& scene,
                                      const RegionSettings& settings,
                                      const RegionMask::Sees& sees) {
  if (auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  if (auto checked = optics::check_ball(scene.ball); !checked) {
    return tl::unexpected(checked.error());
  }
  if (settings.hot_spot_limits.need_surface() && scene.proxy.is_far()) {
    return fail(
        "region: hot_spot_min_area and hot_spot_max_speed are those on the machine's surface: the "
        "rig needs a [scene]");
  }
  auto radiometry = Radiometry::make(settings.radiometry);
  if (!radiometry) return tl::unexpected(radiometry.error());
  auto mask = RegionMask::make(view, settings.outline, sees);
  if (!mask) return tl::unexpected(mask.error());
  return RegionMeter(view, scene, settings, std::move(*mask), std::move(*radiometry));
}

RegionMeter::RegionMeter(const optics::ViewProjection& view, const RegionScene& scene,
                         const RegionSettings& settings, RegionMask mask, Radiometry radiometry)
    : settings_(settings),
      ball_centre_(scene.ball.centre),
      knows_surface_(!scene.proxy.is_far()),
      mask_(std::move(mask)),
      radiometry_(std::move(radiometry)),
      geometry_(view, scene, mask_),
      hot_pixels_(mask_),
      track_(settings.hot_spot_limits),
      plume_pixels_(mask_),
      cooling_(mask_, settings.hot_spot_threshold) {
  std::vector<double> thresholds{settings.hot_spot_threshold};
  if (settings.plume_threshold) thresholds.push_back(*settings.plume_threshold);
  if (settings.spatter_threshold) thresholds.push_back(*settings.spatter_threshold);
  std::ranges::sort(thresholds);
  for (const double threshold : thresholds) levels_.emplace_back(mask_, threshold);
  const auto level_of = [&](double threshold) {
    return static_cast<std::size_t>(std::ranges::find(thresholds, threshold) - thresholds.begin());
  };
  hot_ = level_of(settings.hot_spot_threshold);
  if (settings.plume_threshold) plume_level_ = level_of(*settings.plume_threshold);
  if (settings.spatter_threshold) spatter_level_ = level_of(*settings.spatter_threshold);
}

Signals RegionMeter::measure(const ImageView<const std::uint8_t>& values,
                             const ImageView<const std::uint8_t>& validity, double seconds) {
  return measure_any(values, validity, seconds);
}

Signals RegionMeter::measure(const ImageView<const std::uint16_t>& values,
                             const ImageView<const std::uint8_t>& validity, double seconds) {
  return measure_any(values, validity, seconds);
}

void RegionMeter::reset() {
  cooling_.reset();
  spatter_.reset();
  for (Statistics& statistics : statistics_) statistics.reset();
  track_.reset();
  peak_x_ = peak_y_ = -1;
}

template <class T>
Signals RegionMeter::measure_any(const ImageView<const T>& values,
                                 const ImageView<const std::uint8_t>& validity, double seconds) {
  constexpr double kLongest = 3600;  // s; there is none before the first one
  const double passed = seconds > last_ ? std::min(seconds - last_, kLongest) : 0;
  if (passed == 0) reset();
  last_ = seconds;
  find_levels(values, validity);
  Signals signals;
  signals.hot_spot_present = 0;
  signals.hot_spot_pixels = signals.hot_spot_solid_angle = 0;
  if (knows_surface_) signals.hot_spot_area = 0;
  if (settings_.plume_threshold) signals.plume_area = 0;
  hot_direction_.reset();
  const LevelSet& hot = levels_[hot_];
  const std::size_t chosen = track_.follow(hot, passed);
  hot_pixels_.clear();
  if (chosen != LevelSet::kNone) {
    hot_pixels_.assign(hot, chosen);
    const Blob& blob = hot.blob(chosen);
    peak_x_ = blob.peak_x;
    peak_y_ = blob.peak_y;
    const HotSpot spot = measure_hot_spot(values, validity, hot_pixels_, hot.threshold(),
                                          settings_.full_scale, geometry_, radiometry_);
    if (spot.solid_angle > 0) {
      write(spot, blob, signals);
      hot_direction_ = spot.direction;
      if (plume_level_) {
        signals.plume_area = 1000 * plume(values, validity) - signals.hot_spot_solid_angle;
      }
    }
  }
  if (radiometry_.is_radiometric()) {
    signals.hot_spot_cooling_rate =
        cooling_.update(seconds, values, validity, hot_pixels_, geometry_, radiometry_);
  }
  if (spatter_level_) find_sparks(signals, seconds);
  add_statistics(signals, seconds);
  return signals;
}

/// One pass over the region for the lowest threshold; the others search its runs.
template <class T>
void RegionMeter::find_levels(const ImageView<const T>& values,
                              const ImageView<const std::uint8_t>& validity) {
  levels_.front().find(values, validity, mask_, geometry_);
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    levels_[i].find(values, levels_[i - 1], geometry_);
  }
}

/// Steradian above the plume's threshold around and with the hot spot.
template <class T>
double RegionMeter::plume(const ImageView<const T>& values,
                          const ImageView<const std::uint8_t>& validity) {
  const LevelSet& level = levels_[*plume_level_];
  plume_pixels_.assign(level, level.blob_at(peak_x_, peak_y_));
  return measure_solid_angle(values, validity, plume_pixels_, level.threshold(), geometry_);
}

void RegionMeter::write(const HotSpot& spot, const Blob& blob, Signals& signals) const {
  signals.hot_spot_present = 1;
  signals.hot_spot_confidence = 100 * track_.confidence();
  signals.hot_spot_pixels = spot.pixels;
  signals.hot_spot_solid_angle = 1000 * spot.solid_angle;
  write_angles(spot, signals);
  signals.hot_spot_mean_intensity = 100 * spot.mean / settings_.full_scale;
  signals.hot_spot_peak_intensity = 100 * blob.peak / settings_.full_scale;
  signals.hot_spot_saturated = 100 * spot.saturated;
  if (radiometry_.is_radiometric()) {
    signals.hot_spot_mean_temperature = spot.mean_celsius;
    signals.hot_spot_peak_temperature = radiometry_.celsius(blob.peak);
  }
  signals.hot_spot_area = spot.area;
  if (!is_valid(spot.area)) return;
  signals.hot_spot_length = axis_of(spot.extent.largest);
  signals.hot_spot_width = axis_of(spot.extent.second);
  if (settings_.width_set_point) {
    signals.hot_spot_width_error = signals.hot_spot_width - *settings_.width_set_point;
  }
  signals.hot_spot_orientation_xy =
      orientation(spot.extent, spot.extent.axis.x, spot.extent.axis.y);
  signals.hot_spot_x = ball_centre_.x + spot.position.x;
  signals.hot_spot_y = ball_centre_.y + spot.position.y;
  signals.hot_spot_z = ball_centre_.z + spot.position.z;
}

/// Sparks are the blobs at their threshold other than the hot spot, or its afterglow at its last
/// place.
void RegionMeter::find_sparks(Signals& signals, double seconds) {
  const LevelSet& level = levels_[*spatter_level_];
  const std::size_t around_hot_spot = level.blob_at(peak_x_, peak_y_);
  for (std::size_t i = 0; i < level.size(); ++i) {
    const Blob& blob = level.blob(i);
    if (!level.is_whole(i) || i == around_hot_spot) continue;
    if (hot_pixels_.contains(blob.peak_x, blob.peak_y)) continue;
    spatter_.add(blob.moment);
  }
  spatter_.update(seconds, hot_direction_);
  spatter_.write(signals);
}

void RegionMeter::add_statistics(Signals& signals, double seconds) {
  for (std::size_t i = 0; i < kMainSignals.size(); ++i) {
    const MainSignal& signal = kMainSignals[i];
    statistics_[i].add(seconds, signals.*signal.value);
    const Statistics::Figures figures = statistics_[i].figures();
    signals.*signal.mean = figures.mean;
    signals.*signal.deviation = figures.deviation;
    signals.*signal.trend = figures.trend;
  }
}

}  // namespace orbwatch::signals
