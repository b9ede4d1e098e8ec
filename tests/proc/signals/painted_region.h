// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/region_meter.h"

namespace orbwatch::signals {

/// Threshold of the hot spot in a painted view, counts.
inline constexpr double kHotSpotThreshold = 20000;

/// A ball of 50 mm above a floor 400 mm below its centre.
inline RegionScene floor_scene() {
  optics::Scene scene;
  scene.room = optics::Scene::Room::Plane;
  scene.point = {0, 0, -300};
  scene.normal = {0, 0, 1};
  const optics::Ball ball{{10, 20, 100}, 50};
  return {ball, optics::SceneProxy::make(scene, ball).value()};
}

/// A measured view that tests paint, all of it seen.
struct PaintedView {
  explicit PaintedView(const optics::ViewSpec& spec, std::uint16_t background = 100)
      : view(optics::ViewProjection::make(spec).value()),
        values(static_cast<std::size_t>(spec.width) * spec.height, background),
        validity(values.size(), static_cast<std::uint8_t>(Validity::Seen)) {}

  std::uint16_t& at(int x, int y) { return values[static_cast<std::size_t>(y) * view.width() + x]; }
  std::uint8_t& validity_at(int x, int y) {
    return validity[static_cast<std::size_t>(y) * view.width() + x];
  }

  /// Sets every pixel to the value of `paint` at its direction, if that is higher.
  template <class Paint>
  void paint(const Paint& value_at) {
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        const double value = std::round(value_at(*view.direction(x, y)));
        if (value > at(x, y)) at(x, y) = static_cast<std::uint16_t>(value);
      }
    }
  }
  /// Paints a smooth hill around `centre` that crosses `level` at `radius`, radians, and falls by
  /// half of it within another 0.7 radii.
  void paint_hill(const optics::Vec3& centre, double radius, double level) {
    paint([&](const optics::Vec3& d) {
      const double share = optics::angle_between(d, centre) / radius;
      return 1.5 * level * std::pow(2.0 / 3, share * share);
    });
  }
  void clear(std::uint16_t value = 100) { values.assign(values.size(), value); }

  ImageView<const std::uint16_t> plane() const {
    return {values.data(), view.width(), view.height(), 1, view.width()};
  }
  ImageView<const std::uint8_t> seen() const {
    return {validity.data(), view.width(), view.height(), 1, view.width()};
  }

  optics::ViewProjection view;
  std::vector<std::uint16_t> values;
  std::vector<std::uint8_t> validity;
};

}  // namespace orbwatch::signals
