#include "proc/remap/sampling/downsampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace orbwatch::remap {
namespace {

constexpr double kOne = 1 << kFractionBits;

struct Place {
  double u, v;
};

/// A tile of the map u, v = `at(x, y)`, source pixels.
template <class Map>
CoordinateTile tile_of(const Map& at) {
  CoordinateTile tile;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const Place place = at(x, y);
      tile[y][x] = {static_cast<std::int32_t>(std::lround(place.u * kOne)),
                    static_cast<std::int32_t>(std::lround(place.v * kOne))};
    }
  }
  return tile;
}

/// Calls `look(x, y, coordinate)` for every pixel of the oversampled tile of the first `columns` x
/// `rows` pixels.
template <class Look>
void for_each_sample(const CoordinateTile& tile, int columns, int rows, const Look& look) {
  for (int top = 0; top < 2 * rows; top += kTile) {
    for (int left = 0; left < 2 * columns; left += kTile) {
      CoordinateTile quarter;
      at_half_steps(tile, columns, rows, left, top, quarter);
      for (int y = top; y < std::min(top + kTile, 2 * rows); ++y) {
        for (int x = left; x < std::min(left + kTile, 2 * columns); ++x) {
          look(x, y, quarter[y - top][x - left]);
        }
      }
    }
  }
}

/// Where sample `n` along an axis lies, in the tile's pixels.
double place_of(int n) { return n / 2.0 - 0.25; }

// Steps are shared out with a rounding of one 8192nd each.
TEST(AtHalfSteps, LiesAQuarterOfAPixelBeforeAndBehind) {
  const auto plane = [](double x, double y) {
    return Place{300 + 2.7 * x - 1.3 * y, -20.5 + 0.4 * x + 3.1 * y};
  };
  const CoordinateTile tile = tile_of(plane);
  for (const auto& [columns, rows] : {std::pair{16, 16}, {8, 16}, {8, 8}}) {
    int looked_at = 0;
    for_each_sample(tile, columns, rows, [&](int x, int y, const Coordinate& c) {
      const Place expected = plane(place_of(x), place_of(y));
      EXPECT_NEAR(c.u / kOne, expected.u, 4 / kOne) << x << ' ' << y;
      EXPECT_NEAR(c.v / kOne, expected.v, 4 / kOne) << x << ' ' << y;
      ++looked_at;
    });
    EXPECT_EQ(looked_at, 4 * columns * rows);
  }
}

// Within a bent tile a step is the mean of those before and behind: that is off by a quarter of
// the bend between pixels at most.
TEST(AtHalfSteps, FollowsACurve) {
  constexpr double kBend = 0.02;
  const auto curve = [](double x, double y) {
    return Place{2 * x + kBend * x * x, 2 * y + kBend * y * y};
  };
  for_each_sample(tile_of(curve), kTile, kTile, [&](int x, int y, const Coordinate& c) {
    const Place expected = curve(place_of(x), place_of(y));
    const bool at_border = x < 2 || y < 2 || x >= 30 || y >= 30;
    const double tolerance = (at_border ? kBend * 5 / 16 : kBend / 16) + 4 / kOne;
    EXPECT_NEAR(c.u / kOne, expected.u, tolerance) << x << ' ' << y;
    EXPECT_NEAR(c.v / kOne, expected.v, tolerance) << x << ' ' << y;
  });
}

TEST(AtHalfSteps, KeepsMarkersAndDoesNotLeanOnThem) {
  const auto plane = [](double x, double y) { return Place{100 + 2 * x, 50 + 3 * y}; };
  CoordinateTile tile = tile_of(plane);
  tile[5][7] = {kBlind, 0};
  tile[12][3] = {kOutside, 0};
  for_each_sample(tile, kTile, kTile, [&](int x, int y, const Coordinate& c) {
    const Coordinate& pixel = tile[y / 2][x / 2];
    if (!is_defined(pixel)) {
      EXPECT_EQ(c.u, pixel.u) << x << ' ' << y;
      return;
    }
    const Place expected = plane(place_of(x), place_of(y));
    EXPECT_NEAR(c.u / kOne, expected.u, 4 / kOne) << x << ' ' << y;
    EXPECT_NEAR(c.v / kOne, expected.v, 4 / kOne) << x << ' ' << y;
  });
}

// Two surfaces: each side goes on with its own steps up to the edge.
TEST(AtHalfSteps, DoesNotStepOverAnEdge) {
  constexpr int kEdge = 9;
  const auto side = [](bool second, double x, double y) {
    return second ? Place{500 + 1.5 * x, 10 + 2 * y} : Place{100 + 2 * x, 300 + y};
  };
  const CoordinateTile tile = tile_of([&](int x, int y) { return side(x >= kEdge, x, y); });
  for_each_sample(tile, kTile, kTile, [&](int x, int y, const Coordinate& c) {
    const Place expected = side(x / 2 >= kEdge, place_of(x), place_of(y));
    EXPECT_NEAR(c.u / kOne, expected.u, 4 / kOne) << x << ' ' << y;
    EXPECT_NEAR(c.v / kOne, expected.v, 4 / kOne) << x << ' ' << y;
  });
}

/// A sample of a packed row.
unsigned sample_of(const std::uint8_t* row, int sample, int bytes) {
  std::uint16_t value = 0;
  std::memcpy(&value, row + sample * bytes, static_cast<std::size_t>(bytes));
  return value;
}

TEST(Average, IsTheMeanOfFourInEveryLayout) {
  constexpr std::uint8_t kUntouched = 0xa5;
  std::mt19937 random(3);
  OversampledTile tile;
  for (std::uint8_t& byte : tile.samples) byte = static_cast<std::uint8_t>(random());
  for (std::size_t n = 0; n < kLayouts; ++n) {
    const auto layout = static_cast<Layout>(n);
    const LayoutInfo& facts = info(layout);
    const std::ptrdiff_t from = OversampledTile::stride(layout);
    for (const auto& [columns, rows] : {std::pair{16, 16}, {8, 16}, {8, 8}}) {
      SCOPED_TRACE(testing::Message() << "layout " << n << ' ' << columns << 'x' << rows);
      const std::ptrdiff_t used = columns * facts.out_bytes(), stride = used + 5;
      std::vector<std::uint8_t> out(rows * stride, kUntouched);
      average(tile, layout, {out.data(), stride, columns, rows});
      for (int y = 0; y < rows; ++y) {
        const std::uint8_t* const upper = tile.samples.data() + 2 * y * from;
        for (int k = 0; k < columns * facts.samples; ++k) {
          const int left = k / facts.samples * 2 * facts.samples + k % facts.samples;
          double sum = 0;
          for (const int sample : {left, left + facts.samples}) {
            sum += sample_of(upper, sample, facts.sample_bytes) +
                   sample_of(upper + from, sample, facts.sample_bytes);
          }
          ASSERT_EQ(sample_of(&out[y * stride], k, facts.sample_bytes), std::floor(sum / 4 + 0.5))
              << k << ' ' << y;
        }
        for (std::ptrdiff_t k = used; k < stride; ++k) ASSERT_EQ(out[y * stride + k], kUntouched);
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
