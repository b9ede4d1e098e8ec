// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/point_marks.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

namespace orbwatch::app {
namespace {

tl::unexpected<Error> too_many() {
  return fail(std::to_string(PointMarks::kMost) + " points are marked already, which is the most");
}

}  // namespace

Result<optics::Vec2> PointMarks::place_of(std::span<const SeenPoint> points, std::size_t index,
                                          const optics::Outline& outline) {
  if (points[index].pixel) return *points[index].pixel;
  std::vector<std::vector<align::SmallLight>> elsewhere;
  elsewhere.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (n != index) elsewhere.push_back(points[n].lights);
  }
  if (const auto moved = align::moved_light(points[index].lights, elsewhere, outline)) {
    return *moved;
  }
  const optics::Vec3& p = points[index].point;
  std::ostringstream text;
  text << "no light has moved to (" << p.x << ", " << p.y << ", " << p.z
       << " mm): every one is seen at another point, too; switch the tool's light on and mark the "
          "points anew";
  return fail(text.str());
}

/// Those with other coordinates.
std::vector<PointMarks::SeenPoint> PointMarks::others(const optics::Vec3& point) const {
  std::vector<SeenPoint> points = points_;
  std::erase_if(points, [&](const SeenPoint& seen) {
    return seen.point.x == point.x && seen.point.y == point.y && seen.point.z == point.z;
  });
  return points;
}

bool PointMarks::remove(const optics::Vec3& point) {
  std::vector<SeenPoint> rest = others(point);
  const bool is_there = rest.size() < points_.size();
  points_ = std::move(rest);
  return is_there;
}

Result<> PointMarks::add(const optics::Vec3& point, const optics::Vec2& pixel) {
  std::vector<SeenPoint> points = others(point);
  if (points.size() >= kMost) return too_many();
  points.push_back({point, {}, pixel});
  points_ = std::move(points);
  return {};
}

Result<> PointMarks::add(const optics::Vec3& point, std::span<const Picture> pictures,
                         const optics::Outline& outline) {
  auto lights = align::small_lights(pictures, outline);
  if (!lights) return tl::unexpected(lights.error());
  std::vector<SeenPoint> points = others(point);
  if (points.size() >= kMost) return too_many();
  points.push_back({point, std::move(*lights), {}});
  const auto own = place_of(points, points.size() - 1, outline);
  if (!own) return tl::unexpected(own.error());
  points_ = std::move(points);
  return {};
}

Result<std::vector<KnownPoint>> PointMarks::points(const optics::Outline& outline) const {
  std::vector<KnownPoint> points;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const auto pixel = place_of(points_, n, outline);
    if (!pixel) return tl::unexpected(pixel.error());
    points.push_back({*pixel, points_[n].point});
  }
  return points;
}

}  // namespace orbwatch::app
