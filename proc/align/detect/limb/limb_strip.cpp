// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orbwatch::align {
namespace {

constexpr double kSpoiltBorder = 2;  // px at the picture's border that filters spoil

double girth(const optics::Outline& outline) {
  return std::numbers::pi * (outline.rx + outline.ry);
}

}  // namespace

LimbStrip::LimbStrip(const cv::Mat& luminance, const optics::Outline& outline, double reach)
    : SlopeStrip(luminance, places(outline, static_cast<int>(reach * kPerUnit)),
                 rays_of(outline) / girth(outline), kSpoiltBorder) {}

int LimbStrip::rays_of(const optics::Outline& outline) {
  constexpr double kApart = 1.5;  // px
  return std::clamp(static_cast<int>(girth(outline) / kApart), 128, 2048) / kTogether * kTogether;
}

/// `steps`: columns on each side.
SlopeStrip::Places LimbStrip::places(const optics::Outline& outline, int steps) {
  const int rays = rays_of(outline), columns = 2 * steps + 1;
  Places places(rays, columns);
  const double turn = optics::radians(outline.angle), ct = std::cos(turn), st = std::sin(turn);
  for (int ray = 0; ray < rays; ++ray) {
    const double angle = 2 * std::numbers::pi * ray / rays;
    const double c = std::cos(angle), s = std::sin(angle);
    const double length = std::hypot(outline.ry * c, outline.rx * s);
    const double nx = outline.ry * c / length, ny = outline.rx * s / length;
    for (int k = 0; k < columns; ++k) {
      const double t = static_cast<double>(k - steps) / kPerUnit;
      const double x = outline.rx * c + nx * t, y = outline.ry * s + ny * t;
      places.u.at<float>(ray, k) = static_cast<float>(outline.centre.u + x * ct - y * st);
      places.v.at<float>(ray, k) = static_cast<float>(outline.centre.v + x * st + y * ct);
    }
  }
  return places;
}

}  // namespace orbwatch::align
