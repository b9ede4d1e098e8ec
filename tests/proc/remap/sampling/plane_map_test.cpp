// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/plane_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "proc/optics/vec.h"
#include "proc/remap/compiler/tolerance.h"
#include "tests/proc/remap/kernel/random_patch.h"

namespace orbwatch::remap {
namespace {

using optics::Vec2;

/// One axis at any place of the tile, source pixels, in double precision.
double at(const Quadratic& q, double x, double y) {
  const auto n = [](std::int64_t value) { return static_cast<double>(value); };
  return (n(q.value) + x * n(q.x) + y * n(q.y) + x * y * n(q.xy) + x * x * n(q.xx) +
          y * y * n(q.yy)) /
         (kOnePixel * (1 << PatchRow::kScaleBits));
}

Vec2 at(const Patch& patch, double x, double y) {
  return {at(patch.u(), x, y), at(patch.v(), x, y)};
}

/// Coordinates are rounded to an 8192nd of a pixel, and each operation may lose less than another.
constexpr double kRounding = 1.5 / kOnePixel;

void expect_near(const Coordinate& found, const Vec2& expected, int x, int y) {
  EXPECT_NEAR(found.u / kOnePixel, expected.u, kRounding) << x << ' ' << y;
  EXPECT_NEAR(found.v / kOnePixel, expected.v, kRounding) << x << ' ' << y;
}

/// Calls `look` with many patches: level ones, and those as steep and curved as blocks are.
template <class Look>
void for_each_patch(const Look& look) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const tests::Steepness most{round % 3 ? 1.5 : 0.1, round % 5 ? 0.02 : 0};
    SCOPED_TRACE(testing::Message() << "round " << round);
    look(tests::RandomPatch(random, most).patch());
    if (testing::Test::HasFailure()) return;
  }
}

template <class Expected>
void expect_map(const Patch& patch, int columns, int rows, const Expected& expected) {
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) expect_near(patch.at(x, y), expected(x, y), x, y);
  }
}

// Halving puts a pixel's centre between those of 2x2.
TEST(OnLevel, CountsThePixelsOfTheLevel) {
  for_each_patch([](const Patch& patch) {
    for (int level = 0; level <= 3; ++level) {
      const double scale = 1 << level;
      expect_map(on_level(patch, level), kTile, kTile, [&](int x, int y) {
        const Vec2 full = at(patch, x, y);
        return Vec2{(full.u + 0.5) / scale - 0.5, (full.v + 0.5) / scale - 0.5};
      });
    }
  });
}

TEST(OnLevel, KeepsTheMarkersOfATile) {
  CoordinateTile tile{};
  for (CoordinateRow& row : tile) row.fill({static_cast<std::int32_t>(100.5 * kOnePixel), 0});
  tile[3][4] = {kBlind, 0};
  tile[15][0] = {kOutside, 0};
  on_level(tile, 2);
  EXPECT_EQ(tile[3][4].u, kBlind);
  EXPECT_EQ(tile[15][0].u, kOutside);
  EXPECT_DOUBLE_EQ(tile[0][0].u / kOnePixel, 101 / 4.0 - 0.5);
  EXPECT_DOUBLE_EQ(tile[0][0].v / kOnePixel, 0.5 / 4 - 0.5);
}

TEST(InSteps, ReachesTheSamePlaces) {
  std::mt19937 random(4);
  for (int round = 0; round < 100; ++round) {
    const Patch patch = tests::RandomPatch(random, {3, 0.1}).patch();
    for (const int bits : {0, 1, 2}) {
      const Patch long_steps = in_steps(patch, bits);
      for (int y = 0; y < kTile >> bits; ++y) {
        for (int x = 0; x < kTile >> bits; ++x) {
          const Coordinate expected = patch.at(x << bits, y << bits), there = long_steps.at(x, y);
          ASSERT_EQ(there.u, expected.u);
          ASSERT_EQ(there.v, expected.v);
        }
      }
    }
  }
}

TEST(AtHalfSteps, LiesAQuarterOfAPixelBeforeAndBehind) {
  for_each_patch([](const Patch& patch) {
    expect_map(at_half_steps(patch), kTile, kTile,
               [&](int x, int y) { return at(patch, x / 2.0 - 0.25, y / 2.0 - 0.25); });
  });
}

TEST(AtHalfStepsAlongAnAxis, LiesAQuarterOfAPixelBeforeAndBehind) {
  for_each_patch([](const Patch& patch) {
    expect_map(at_half_steps_along_x(patch), kTile, kTile,
               [&](int x, int y) { return at(patch, x / 2.0 - 0.25, y); });
    expect_map(at_half_steps_along_y(patch), kTile, kTile,
               [&](int x, int y) { return at(patch, x, y / 2.0 - 0.25); });
  });
}

TEST(AtHalfRows, TakesEveryRowTwice) {
  for_each_patch([](const Patch& patch) {
    expect_map(at_half_rows(patch), kTile, kTile,
               [&](int x, int y) { return at(patch, x, y / 2.0); });
  });
}

TEST(AtHalfColumns, TakesEveryColumnTwice) {
  for_each_patch([](const Patch& patch) {
    expect_map(at_half_columns(patch), kTile, kTile,
               [&](int x, int y) { return at(patch, x / 2.0, y); });
  });
}

TEST(Moved, GoesOnFromItsPixel) {
  for_each_patch([](const Patch& patch) {
    for (const auto& [right, down] : {std::pair{0, 0}, {16, 0}, {0, 16}, {16, 16}, {3, 11}}) {
      expect_map(moved(patch, right, down), kTile, kTile,
                 [&, x0 = right, y0 = down](int x, int y) { return at(patch, x0 + x, y0 + y); });
    }
  });
}

// All four quarters of an oversampled tile, in the order of sampling.
TEST(Moved, GoesOnFromAPatchInHalfSteps) {
  for_each_patch([](const Patch& patch) {
    const Patch fine = at_half_steps(patch);
    for (const int top : {0, kTile}) {
      for (const int left : {0, kTile}) {
        expect_map(moved(fine, left, top), kTile, kTile, [&](int x, int y) {
          return at(patch, (left + x) / 2.0 - 0.25, (top + y) / 2.0 - 0.25);
        });
      }
    }
  });
}

/// Converts a plane's pixel along an axis to the picture's pixels, and back.
double in_picture(double pixel, Siting siting) {
  if (siting == Siting::Full) return pixel;
  return siting == Siting::Centred ? 2 * pixel + 0.5 : 2 * pixel;
}
double in_plane(double pixel, Siting siting) {
  if (siting == Siting::Full) return pixel;
  return siting == Siting::Centred ? (pixel - 0.5) / 2 : pixel / 2;
}

/// Calls `look` for every siting that exists.
template <class Look>
void for_each_siting(const Look& look) {
  for (const auto& [x, y] : {std::pair{Siting::Full, Siting::Full},
                             {Siting::Cosited, Siting::Full},
                             {Siting::Centred, Siting::Centred}}) {
    SCOPED_TRACE(testing::Message()
                 << "siting " << static_cast<int>(x) << ' ' << static_cast<int>(y));
    PlaneSampling sampling{Layout::One8};
    sampling.x = x;
    sampling.y = y;
    look(sampling);
  }
}

/// Place of the view's pixel of a plane in the source's plane, if `full` is the picture's map.
template <class Full>
Vec2 plane_place(const Full& full, const PlaneSampling& sampling, int x, int y) {
  const Vec2 place = full(in_picture(x, sampling.x), in_picture(y, sampling.y));
  return {in_plane(place.u, sampling.x), in_plane(place.v, sampling.y)};
}

TEST(OnPlane, IsTheMapAtTheMiddleOfTheSharedPixels) {
  for_each_siting([](const PlaneSampling& sampling) {
    for_each_patch([&](const Patch& patch) {
      expect_map(on_plane(patch, sampling), kTile >> shift(sampling.x), kTile >> shift(sampling.y),
                 [&](int x, int y) {
                   return plane_place([&](double u, double v) { return at(patch, u, v); }, sampling,
                                      x, y);
                 });
    });
  });
}

/// A tile of a level map.
Vec2 level_map(double x, double y) { return {200 + 1.7 * x - 0.6 * y, 90 + 0.9 * x + 1.2 * y}; }

CoordinateTile level_tile() {
  CoordinateTile tile;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const Vec2 place = level_map(x, y);
      tile[y][x] = {static_cast<std::int32_t>(std::lround(place.u * kOnePixel)),
                    static_cast<std::int32_t>(std::lround(place.v * kOnePixel))};
    }
  }
  return tile;
}

// A plane of single pixels has one siting along both axes, or is not shared along one of them.
TEST(OnPlane, OfATileLiesInTheMiddleOfTheSharedPixels) {
  for (const auto& [x_siting, y_siting] : {std::pair{Siting::Full, Siting::Full},
                                           {Siting::Cosited, Siting::Full},
                                           {Siting::Centred, Siting::Centred}}) {
    PlaneSampling sampling{Layout::One8};
    sampling.x = x_siting;
    sampling.y = y_siting;
    CoordinateTile plane;
    on_plane(level_tile(), sampling, plane);
    for (int y = 0; y < kTile >> shift(sampling.y); ++y) {
      for (int x = 0; x < kTile >> shift(sampling.x); ++x) {
        expect_near(plane[y][x], plane_place(level_map, sampling, x, y), x, y);
      }
    }
  }
}

constexpr PlaneSampling kChroma420{Layout::Two8, 1, 0, Siting::Centred, Siting::Centred, 128};

/// Expects the place of a pixel of the picture, in the plane of kChroma420.
void expect_place_of(const CoordinateTile& tile, const CoordinateTile& plane, int x, int y) {
  expect_near(plane[y / 2][x / 2],
              {in_plane(tile[y][x].u / kOnePixel, Siting::Centred),
               in_plane(tile[y][x].v / kOnePixel, Siting::Centred)},
              x, y);
}

TEST(OnPlane, OfATileTakesTheFirstThatIsDefined) {
  CoordinateTile tile = level_tile(), plane;
  tile[4][6] = {kBlind, 0};
  tile[9][11] = {kOutside, 0};
  on_plane(tile, kChroma420, plane);
  expect_place_of(tile, plane, 7, 4);
  expect_place_of(tile, plane, 10, 8);
}

TEST(OnPlane, OfATileDoesNotMixTwoSurfaces) {
  CoordinateTile tile = level_tile(), plane;
  for (const auto& [x, y] : {std::pair{3, 2}, {2, 7}, {3, 7}}) {
    tile[y][x].u += static_cast<std::int32_t>(40 * kOnePixel);
  }
  on_plane(tile, kChroma420, plane);
  expect_place_of(tile, plane, 2, 2);
  expect_place_of(tile, plane, 2, 6);
}

// Outside of the picture has priority over not shown by the ball.
TEST(OnPlane, OfATileSaysWhyNothingIsDefined) {
  CoordinateTile tile = level_tile(), plane;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    tile[y][x] = {kBlind, 0};
    tile[y][x + 2] = {x + y == 1 ? kOutside : kBlind, 0};
  }
  on_plane(tile, kChroma420, plane);
  EXPECT_EQ(plane[0][0].u, kBlind);
  EXPECT_EQ(plane[0][1].u, kOutside);
}

}  // namespace
}  // namespace orbwatch::remap
