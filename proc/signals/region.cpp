// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "proc/signals/spherical_polygon.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::array<float, 3> single(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Point of the smooth surface `surface` at the view's pixel (u, v), mm from the ball's centre.
std::optional<Vec3> on_surface(const optics::ViewProjection& view, const RegionScene& scene,
                               int surface, double u, double v) {
  const auto direction = view.direction(u, v);
  if (!direction) return std::nullopt;
  const double closeness = scene.proxy.closeness(surface, *direction);
  if (!(closeness > 0)) return std::nullopt;
  return *direction * (scene.ball.radius / closeness);
}

/// Area of the pixel, mm2: the parallelogram between the middles of its sides. On its own surface,
/// also where the next pixel shows another.
float surface_area(const optics::ViewProjection& view, const RegionScene& scene, int surface,
                   double u, double v) {
  const auto place = [&](double du, double dv) {
    return on_surface(view, scene, surface, u + du, v + dv);
  };
  const auto left = place(-0.5, 0), right = place(0.5, 0);
  const auto above = place(0, -0.5), below = place(0, 0.5);
  if (!left || !right || !above || !below) return kUnknown;
  return static_cast<float>(optics::norm(optics::cross(*right - *left, *below - *above)));
}

PixelGeometry geometry_of(const optics::ViewProjection& view, const RegionScene& scene, int x,
                          int y) {
  PixelGeometry pixel;
  pixel.position.fill(kUnknown);
  pixel.area = kUnknown;
  const auto direction = view.direction(x, y);
  if (!direction) return pixel;
  pixel.direction = single(*direction);
  pixel.solid_angle = static_cast<float>(view.solid_angle(x, y));
  const auto hit = scene.proxy.hit(*direction);
  if (!(hit.closeness > 0)) return pixel;
  pixel.position = single(*direction * (scene.ball.radius / hit.closeness));
  pixel.area = surface_area(view, scene, hit.surface, x, y);
  return pixel;
}

}  // namespace

Result<RegionMask> RegionMask::make(const optics::ViewProjection& view,
                                    std::span<const Vec3> outline, const Sees& sees) {
  std::optional<SphericalPolygon> polygon;
  if (!outline.empty()) {
    auto made = SphericalPolygon::make(outline);
    if (!made) return tl::unexpected(made.error());
    polygon = std::move(*made);
  }
  const auto inside = [&](int x, int y) {
    const auto direction = view.direction(x, y);
    if (!direction || (polygon && !polygon->contains(*direction))) return false;
    return !sees || sees(*direction);
  };
  RegionMask mask;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      if (!inside(x, y)) continue;
      const int begin = x;
      while (x < view.width() && inside(x, y)) ++x;
      mask.spans_.push_back({y, begin, x});
    }
  }
  if (mask.spans_.empty()) {
    return fail(
        "region: it has no pixel of its measurement view inside that the measured camera sees; "
        "point the view at it");
  }
  mask.top_ = mask.spans_.front().y;
  mask.bottom_ = mask.spans_.back().y + 1;
  mask.left_ = view.width();
  for (const Span& span : mask.spans_) {
    mask.left_ = std::min(mask.left_, span.begin);
    mask.right_ = std::max(mask.right_, span.end);
    const auto length = static_cast<std::size_t>(span.end - span.begin);
    mask.pixels_ += length;
    mask.most_runs_ += (length + 1) / 2;
  }
  return mask;
}

RegionGeometry::RegionGeometry(const optics::ViewProjection& view, const RegionScene& scene,
                               const RegionMask& mask)
    : left_(mask.left()), top_(mask.top()), width_(mask.right() - mask.left()) {
  pixels_.reserve(static_cast<std::size_t>(width_) *
                  static_cast<std::size_t>(mask.bottom() - mask.top()));
  for (int y = mask.top(); y < mask.bottom(); ++y) {
    for (int x = mask.left(); x < mask.right(); ++x) {
      const PixelGeometry& pixel = pixels_.emplace_back(geometry_of(view, scene, x, y));
      largest_solid_angle_ = std::max<double>(largest_solid_angle_, pixel.solid_angle);
      // std::max keeps the old value if unknown.
      largest_area_ = std::max<double>(largest_area_, pixel.area);
    }
  }
}

}  // namespace orbwatch::signals
