// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/spherical_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace orbwatch::signals {
namespace {

using optics::Vec2;
using optics::Vec3;
using optics::ViewKind;
using optics::ViewProjection;

double distance(const Vec2& a, const Vec2& b) { return std::hypot(a.u - b.u, a.v - b.v); }

double distance_to_piece(const Vec2& at, const Vec2& from, const Vec2& to) {
  const double du = to.u - from.u, dv = to.v - from.v, square = du * du + dv * dv;
  const double share =
      square > 0 ? std::clamp(((at.u - from.u) * du + (at.v - from.v) * dv) / square, 0.0, 1.0) : 0;
  return distance(at, {from.u + share * du, from.v + share * dv});
}

/// A star about a direction that the view shows: not convex.
std::vector<Vec3> star(const ViewProjection& view, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 middle = *view.direction(view.width() * (0.3 + 0.4 * unit(random)),
                                      view.height() * (0.3 + 0.4 * unit(random)));
  const Vec3 right = optics::normalized(optics::cross(middle, {0.1, 0.2, 1}));
  const Vec3 up = optics::cross(right, middle);
  std::vector<Vec3> outline;
  for (int i = 0; i < 7; ++i) {
    const double angle = 2 * std::numbers::pi * i / 7, out = 0.2 + 0.4 * unit(random);
    outline.push_back((middle + (right * std::cos(angle) + up * std::sin(angle)) * out) * 300);
  }
  return outline;
}

class Lines : public testing::TestWithParam<optics::ViewSpec> {
 protected:
  bool is_near_a_corner(const Vec2& at) const {
    return std::ranges::any_of(outline, [&](const Vec3& corner) {
      const auto pixel = view.pixel(optics::normalized(corner));
      return pixel && distance(*pixel, at) < 1.5;
    });
  }
  bool is_inside(double u, double v) const {
    const auto direction = view.direction(u, v);
    return direction && polygon.contains(*direction);
  }
  double distance_to_lines(const Vec2& at) const {
    double nearest = 1e9;
    for (const auto& line : lines) {
      for (std::size_t i = 1; i < line.size(); ++i) {
        nearest = std::min(nearest, distance_to_piece(at, line[i - 1], line[i]));
      }
    }
    return nearest;
  }

  const ViewProjection view = ViewProjection::make(GetParam()).value();
  std::mt19937 random{18};
  std::vector<Vec3> outline = star(view, random);
  SphericalPolygon polygon = SphericalPolygon::make(outline).value();
  std::vector<std::vector<Vec2>> lines = polygon.lines_in(view);
};

TEST_P(Lines, SeparateInsideFromOutside) {
  int pieces = 0;
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vec2 &a = line[i - 1], &b = line[i];
      const Vec2 middle{(a.u + b.u) / 2, (a.v + b.v) / 2};
      if (is_near_a_corner(middle)) continue;
      const double across = 0.2 / distance(a, b);
      const double du = -(b.v - a.v) * across, dv = (b.u - a.u) * across;
      EXPECT_NE(is_inside(middle.u + du, middle.v + dv), is_inside(middle.u - du, middle.v - dv))
          << middle.u << ", " << middle.v;
      ++pieces;
    }
  }
  EXPECT_GT(pieces, 20);
}

TEST_P(Lines, RunWhereverPixelsChangeSides) {
  int changes = 0;
  for (int v = 0; v < view.height(); ++v) {
    for (int u = 1; u < view.width(); ++u) {
      if (is_inside(u - 1, v) == is_inside(u, v)) continue;
      EXPECT_LT(distance_to_lines({u - 0.5, double(v)}), 0.6) << u << ", " << v;
      ++changes;
    }
  }
  EXPECT_GT(changes, 20);
}

TEST_P(Lines, StayNearTheView) {
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      EXPECT_LT(distance(line[i - 1], line[i]), view.width() / 4.0);
    }
  }
}

// A view that a polygon fits into, one across whose seam it runs, one that cuts it off.
INSTANTIATE_TEST_SUITE_P(
    OfViews, Lines,
    testing::Values(optics::ViewSpec{ViewKind::Perspective, {30, -20, 10}, 90, {}, 120, 90},
                    optics::ViewSpec{ViewKind::Equirectangular, {170, 0, 0}, {}, {}, 240, 120},
                    optics::ViewSpec{ViewKind::Fisheye, {0, 40, 0}, 180, {}, 120, 120},
                    optics::ViewSpec{ViewKind::Perspective, {-90, 0, 0}, 30, {}, 120, 90}));

TEST(SphericalPolygon, RefusesWhatIsNone) {
  EXPECT_FALSE(SphericalPolygon::make(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(SphericalPolygon::make(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}));
  EXPECT_FALSE(SphericalPolygon::make(std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}));
}

}  // namespace
}  // namespace orbwatch::signals
