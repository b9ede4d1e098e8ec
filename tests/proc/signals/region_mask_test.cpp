// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "proc/optics/vec.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;
using optics::ViewKind;
using optics::ViewProjection;

/// Number of times that the outline winds around a direction, from the angles of its sides.
int turns(const std::vector<Vec3>& outline, const Vec3& d) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 a = optics::cross(d, outline[i]);
    const Vec3 b = optics::cross(d, outline[(i + 1) % outline.size()]);
    sum += std::atan2(optics::dot(d, optics::cross(a, b)), optics::dot(a, b));
  }
  return static_cast<int>(std::lround(sum / (2 * std::numbers::pi)));
}

TEST(RegionMask, IsTheSphericalPolygon) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const auto& spec :
       {optics::ViewSpec{ViewKind::Perspective, {30, -20, 10}, 90, {}, 80, 60},
        optics::ViewSpec{ViewKind::Equirectangular, {170, 0, 0}, {}, {}, 120, 60}}) {
    const auto view = ViewProjection::make(spec).value();
    for (int round = 0; round < 10; ++round) {
      const Vec3 middle = *view.direction(spec.width * unit(random), spec.height * unit(random));
      const Vec3 right = optics::normalized(optics::cross(middle, {0.1, 0.2, 1}));
      const Vec3 up = optics::cross(right, middle);
      std::vector<Vec3> outline;  // a star: not convex
      for (int i = 0; i < 7; ++i) {
        const double angle = 2 * std::numbers::pi * i / 7, out = 0.2 + 0.6 * unit(random);
        outline.push_back((middle + (right * std::cos(angle) + up * std::sin(angle)) * out) * 300);
      }
      const auto mask = RegionMask::make(view, outline).value();
      std::vector<bool> inside(static_cast<std::size_t>(spec.width) * spec.height);
      std::size_t pixels = 0;
      for (const Span& span : mask.spans()) {
        EXPECT_GE(span.begin, mask.left());
        EXPECT_LE(span.end, mask.right());
        for (int x = span.begin; x < span.end; ++x, ++pixels) {
          inside[static_cast<std::size_t>(span.y) * spec.width + x] = true;
        }
      }
      EXPECT_EQ(mask.pixels(), pixels);
      for (int y = 0; y < spec.height; ++y) {
        for (int x = 0; x < spec.width; ++x) {
          const Vec3 d = *view.direction(x, y);
          const bool expected = turns(outline, d) != 0 && optics::dot(d, middle) > 0;
          ASSERT_EQ(inside[static_cast<std::size_t>(y) * spec.width + x], expected)
              << x << ", " << y;
        }
      }
    }
  }
}

TEST(RegionMask, WithoutAnOutlineIsWhatTheViewShows) {
  const auto view = ViewProjection::make({ViewKind::Fisheye, {}, 360, {}, 60, 60}).value();
  const auto mask = RegionMask::make(view, {}).value();
  EXPECT_LT(mask.pixels(), 3600U) << "the corners of a fisheye show nothing";
  EXPECT_GT(mask.pixels(), 2700U);
}

TEST(RegionMask, LeavesOutWhatTheCameraDoesNotSee) {
  const auto view = ViewProjection::make({ViewKind::Perspective, {0, 0, 0}, 90, {}, 80, 60});
  const auto mask = RegionMask::make(*view, {}, [](const Vec3& d) { return d.x > 0; }).value();
  EXPECT_EQ(mask.left(), 40);
  EXPECT_EQ(mask.right(), 80);
  EXPECT_EQ(mask.pixels(), 40U * 60U);
  EXPECT_FALSE(RegionMask::make(*view, {}, [](const Vec3&) { return false; }));
}

TEST(RegionMask, RefusesOutlinesThatAreNone) {
  const auto view = ViewProjection::make({ViewKind::Perspective, {}, 60, {}, 60, 40}).value();
  const auto refused = [&](const std::vector<Vec3>& outline) {
    return !RegionMask::make(view, outline);
  };
  EXPECT_TRUE(refused({{0, 1, 0}, {0.1, 1, 0}}));
  EXPECT_TRUE(refused({{0, 1, 0}, {0.1, 1, 0}, {0, 0, 0}}));
  EXPECT_TRUE(refused({{0, 1, 0}, {0.1, 1, 0}, {NAN, 1, 0}}));
  EXPECT_TRUE(refused({{0, 1, 0}, {0.1, 1, 0}, {INFINITY, 1, 0}}));
  EXPECT_TRUE(refused({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}})) << "all around";
  EXPECT_TRUE(refused({{0, -1, 0}, {0.1, -1, 0}, {0, -1, 0.1}})) << "behind the view";
  EXPECT_FALSE(refused({{0, 1, 0}, {0.1, 1, 0}, {0, 1, 0.1}}));
}

}  // namespace
}  // namespace orbwatch::signals
