// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/half_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "proc/optics/vec.h"
#include "proc/remap/compiler/tolerance.h"

namespace orbwatch::remap {
namespace {

using optics::Vec2;

/// A tile of the map u, v = `at(x, y)`, source pixels.
template <class Map>
CoordinateTile tile_of(const Map& at) {
  CoordinateTile tile;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const Vec2 place = at(x, y);
      tile[y][x] = {static_cast<std::int32_t>(std::lround(place.u * kOnePixel)),
                    static_cast<std::int32_t>(std::lround(place.v * kOnePixel))};
    }
  }
  return tile;
}

/// Calls `look(x, y, coordinate)` for every pixel of the oversampled tile of the first `columns` x
/// `rows` pixels.
template <class Look>
void for_each_sample(const CoordinateTile& tile, int columns, int rows, const Look& look) {
  const HalfSteps steps(tile, columns, rows);
  for (int top = 0; top < 2 * rows; top += kTile) {
    for (int left = 0; left < 2 * columns; left += kTile) {
      Places quarter;
      steps.locate(left, top, quarter);
      for (int n = 0; n < kTile * kTile; ++n) {
        look(left + n % kTile, top + n / kTile, Coordinate{quarter.u[n], quarter.v[n]});
      }
    }
  }
}

/// Place of sample `n` along an axis, in the tile's pixels.
double place_of(int n) { return n / 2.0 - 0.25; }

// Steps are divided with a rounding of one 8192nd each.
TEST(HalfSteps, LiesAQuarterOfAPixelBeforeAndBehind) {
  const auto plane = [](double x, double y) {
    return Vec2{300 + 2.7 * x - 1.3 * y, -20.5 + 0.4 * x + 3.1 * y};
  };
  const CoordinateTile tile = tile_of(plane);
  for (const auto& [columns, rows] : {std::pair{16, 16}, {8, 16}, {8, 8}}) {
    int looked_at = 0;
    for_each_sample(tile, columns, rows, [&](int x, int y, const Coordinate& c) {
      const Vec2 expected = plane(place_of(x), place_of(y));
      EXPECT_NEAR(c.u / kOnePixel, expected.u, 4 / kOnePixel) << x << ' ' << y;
      EXPECT_NEAR(c.v / kOnePixel, expected.v, 4 / kOnePixel) << x << ' ' << y;
      ++looked_at;
    });
    EXPECT_EQ(looked_at, 4 * columns * rows);
  }
}

// A step within a curved tile is the mean of those before and behind: that is off by at most a
// quarter of the second difference between pixels.
TEST(HalfSteps, FollowsACurve) {
  constexpr double kBend = 0.02;
  const auto curve = [](double x, double y) {
    return Vec2{2 * x + kBend * x * x, 2 * y + kBend * y * y};
  };
  for_each_sample(tile_of(curve), kTile, kTile, [&](int x, int y, const Coordinate& c) {
    const Vec2 expected = curve(place_of(x), place_of(y));
    const bool at_border = x < 2 || y < 2 || x >= 30 || y >= 30;
    const double tolerance = (at_border ? kBend * 5 / 16 : kBend / 16) + 4 / kOnePixel;
    EXPECT_NEAR(c.u / kOnePixel, expected.u, tolerance) << x << ' ' << y;
    EXPECT_NEAR(c.v / kOnePixel, expected.v, tolerance) << x << ' ' << y;
  });
}

TEST(HalfSteps, KeepsMarkersAndDoesNotLeanOnThem) {
  const auto plane = [](double x, double y) { return Vec2{100 + 2 * x, 50 + 3 * y}; };
  CoordinateTile tile = tile_of(plane);
  tile[5][7] = {kBlind, 0};
  tile[12][3] = {kOutside, 0};
  for_each_sample(tile, kTile, kTile, [&](int x, int y, const Coordinate& c) {
    const Coordinate& pixel = tile[y / 2][x / 2];
    if (!is_defined(pixel)) {
      EXPECT_EQ(c.u, pixel.u) << x << ' ' << y;
      return;
    }
    const Vec2 expected = plane(place_of(x), place_of(y));
    EXPECT_NEAR(c.u / kOnePixel, expected.u, 4 / kOnePixel) << x << ' ' << y;
    EXPECT_NEAR(c.v / kOnePixel, expected.v, 4 / kOnePixel) << x << ' ' << y;
  });
}

// Two surfaces: each side continues with its own steps up to the edge.
TEST(HalfSteps, DoesNotStepOverAnEdge) {
  constexpr int kEdge = 9;
  const auto side = [](bool second, double x, double y) {
    return second ? Vec2{500 + 1.5 * x, 10 + 2 * y} : Vec2{100 + 2 * x, 300 + y};
  };
  const CoordinateTile tile = tile_of([&](int x, int y) { return side(x >= kEdge, x, y); });
  for_each_sample(tile, kTile, kTile, [&](int x, int y, const Coordinate& c) {
    const Vec2 expected = side(x / 2 >= kEdge, place_of(x), place_of(y));
    EXPECT_NEAR(c.u / kOnePixel, expected.u, 4 / kOnePixel) << x << ' ' << y;
    EXPECT_NEAR(c.v / kOnePixel, expected.v, 4 / kOnePixel) << x << ' ' << y;
  });
}

}  // namespace
}  // namespace orbwatch::remap
