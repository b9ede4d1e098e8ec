// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/region_meter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "proc/optics/vec.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

Result<> check_counts(const std::string& name, double value, double full_scale) {
  if (value > 0 && value <= full_scale) return {};
  return fail("region: the " + name + " is " + std::to_string(value) +
              " counts; it must be above 0 and at most full scale, " + std::to_string(full_scale));
}

Result<> check_hot_spot(const HotSpotLimits& limits) {
  if (!(limits.min_area >= 0 && std::isfinite(limits.min_area))) {
    return fail("region: the hot spot's least area is " + std::to_string(limits.min_area) +
                " mm2; it must be 0 or more");
  }
  if (limits.max_speed > 0) return {};
  return fail("region: the hot spot's highest speed is " + std::to_string(limits.max_speed) +
              " mm/s; it must be above 0");
}

Result<> check_settings(const RegionSettings& s) {
  if (!(s.full_scale > 0 && s.full_scale <= 65535)) {
    return fail("region: full scale is " + std::to_string(s.full_scale) +
                " counts; it must be above 0 and at most 65535");
  }
  auto checked = check_counts("hot spot threshold", s.hot_spot_threshold, s.full_scale);
  if (checked && s.plume_threshold)
    checked = check_counts("plume threshold", *s.plume_threshold, s.full_scale);
  if (checked && s.spatter_threshold) {
    checked = check_counts("spatter threshold", *s.spatter_threshold, s.full_scale);
  }
  if (!checked) return checked;
  if (s.plume_threshold && *s.plume_threshold >= s.hot_spot_threshold) {
    return fail("region: the plume threshold must be below the hot spot's");
  }
  if (s.width_set_point && !(*s.width_set_point > 0 && std::isfinite(*s.width_set_point))) {
    return fail("region: the width's set-point must be above 0 mm");
  }
  return check_hot_spot(s.hot_spot_limits);
}

/// The full axis of the ellipse whose variance along it is `variance`.
double axis_of(double variance) { return 4 * std::sqrt(variance); }

/// The same on the unit sphere, degrees.
double angle_of(double variance) {
  return optics::degrees(2 * std::asin(std::min(1.0, 2 * std::sqrt(variance))));
}

/// Orientation of an axis, degrees in (-90, 90]; not valid when the ellipse is too round to have
/// one.
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

Result<RegionMeter::Parts> RegionMeter::make_parts(const optics::ViewProjection& view,
                                                   const RegionScene& scene,
                                                   const RegionSettings& settings,
                                                   const RegionMask::Sees& sees) {
  if (auto checked = check_settings(settings); !checked) return tl::unexpected(checked.error());
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
  return Parts{std::move(*mask), std::move(*radiometry)};
}

Result<RegionMeter> RegionMeter::make(const optics::ViewProjection& view, const RegionScene& scene,
                                      const RegionSettings& settings, const RegionMask::Sees& sees,
                                      std::shared_ptr<SearchMemory> memory) {
  auto parts = make_parts(view, scene, settings, sees);
  if (!parts) return tl::unexpected(parts.error());
  return RegionMeter(view, scene, settings, std::move(*parts), std::move(memory));
}

Result<> RegionMeter::check(const optics::ViewProjection& view, const RegionScene& scene,
                            const RegionSettings& settings, const RegionMask::Sees& sees) {
  return make_parts(view, scene, settings, sees).map([](const Parts&) {});
}

RegionMeter::RegionMeter(const optics::ViewProjection& view, const RegionScene& scene,
                         const RegionSettings& settings, Parts parts,
                         std::shared_ptr<SearchMemory> memory)
    : settings_(settings),
      ball_centre_(scene.ball.centre),
      knows_surface_(!scene.proxy.is_far()),
      mask_(std::move(parts.mask)),
      radiometry_(std::move(parts.radiometry)),
      geometry_(view, scene, mask_),
      search_(mask_, settings, std::move(memory)),
      hot_pixels_(mask_),
      track_(settings.hot_spot_limits),
      plume_pixels_(mask_),
      cooling_(mask_, settings.hot_spot_threshold) {}

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
  constexpr double kLongest = 3600;  // s; the first frame set has no interval
  const double passed = seconds > last_ ? std::min(seconds - last_, kLongest) : 0;
  if (passed == 0) reset();
  last_ = seconds;
  const BlobSearch::Planes<T> planes{values, validity};
  search_.begin(planes, mask_);
  Signals signals;
  signals.hot_spot_present = 0;
  signals.hot_spot_pixels = signals.hot_spot_solid_angle = 0;
  if (knows_surface_) signals.hot_spot_area = 0;
  if (settings_.plume_threshold) signals.plume_area = 0;
  hot_direction_.reset();
  const auto blob = search_.follow(planes, geometry_, passed, track_);
  hot_pixels_.clear();
  if (blob) measure(planes, *blob, signals);
  if (radiometry_.is_radiometric()) {
    signals.hot_spot_cooling_rate =
        cooling_.update(seconds, values, validity, hot_pixels_, geometry_, radiometry_);
  }
  if (settings_.spatter_threshold) {
    search_.add_sparks(planes, geometry_, hot_pixels_, peak_x_, peak_y_, spatter_);
    spatter_.update(seconds, hot_direction_);
    spatter_.write(signals);
  }
  add_statistics(signals, seconds);
  return signals;
}

/// Measures the hot spot, and the plume around and with it.
template <class T>
void RegionMeter::measure(const BlobSearch::Planes<T>& planes, const Blob& blob, Signals& signals) {
  peak_x_ = blob.peak_x;
  peak_y_ = blob.peak_y;
  search_.assign(planes, settings_.hot_spot_threshold, peak_x_, peak_y_, hot_pixels_);
  const HotSpot spot =
      measure_hot_spot(planes.values, planes.validity, hot_pixels_, settings_.hot_spot_threshold,
                       settings_.full_scale, geometry_, radiometry_);
  if (!(spot.solid_angle > 0)) return;
  write(spot, blob, signals);
  hot_direction_ = spot.direction;
  if (!settings_.plume_threshold) return;
  search_.assign(planes, *settings_.plume_threshold, peak_x_, peak_y_, plume_pixels_);
  const double plume = measure_solid_angle(planes.values, planes.validity, plume_pixels_,
                                           *settings_.plume_threshold, geometry_);
  signals.plume_area = 1000 * plume - signals.hot_spot_solid_angle;
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
