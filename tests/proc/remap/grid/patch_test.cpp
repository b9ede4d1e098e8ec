// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "proc/remap/compiler/tolerance.h"

namespace orbwatch::remap {
namespace {

using Map = std::function<double(double, double)>;

Stencil nodes_of(const Map& u, const Map& v) {
  Stencil nodes;
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      nodes.at(i, j) = {static_cast<std::int32_t>(std::lround(u(i, j) * kOnePixel)),
                        static_cast<std::int32_t>(std::lround(v(i, j) * kOnePixel))};
    }
  }
  return nodes;
}

TEST(Patch, IsExactForTheSecondDegree) {
  const auto u = [](double x, double y) { return 300 + 12 * x - 3 * y + 2 * x * x - y * y; };
  const auto v = [](double x, double y) { return -20 + x + 15 * y + 0.7 * x * y + 0.5 * y * y; };
  const Patch patch(nodes_of(u, v));
  for (int y = 0; y < kTile; ++y) {
    PatchRow row = patch.row(y);
    for (int x = 0; x < kTile; ++x, row.step()) {
      EXPECT_NEAR(row.current().u / kOnePixel, u(x / 16.0, y / 16.0), 2 / kOnePixel);
      EXPECT_NEAR(row.current().v / kOnePixel, v(x / 16.0, y / 16.0), 2 / kOnePixel);
      EXPECT_EQ(patch.at(x, y).u, row.current().u);
      EXPECT_EQ(patch.at(x, y).v, row.current().v);
    }
  }
}

TEST(Patch, WritesRows) {
  const auto u = [](double x, double y) { return -9 * x + y + x * x; };
  const auto v = [](double x, double y) { return 5 * y - x * x; };
  const Patch patch(nodes_of(u, v));
  std::array<Coordinate, kTile> row;
  patch.row(7).write(kTile, row.data());
  for (int x = 0; x < kTile; ++x) {
    EXPECT_EQ(row[x].u, patch.at(x, 7).u);
    EXPECT_EQ(row[x].v, patch.at(x, 7).v);
  }
}

TEST(Patch, StaysWithinItsRange) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-30, 30);
  for (int round = 0; round < 300; ++round) {
    const auto anywhere = [&](double x, double y) { return 20 * (x + y) + place(random); };
    const Patch patch(nodes_of(anywhere, anywhere));
    const auto [low, high] = patch.range();
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const Coordinate c = patch.at(x, y);
        ASSERT_TRUE(c.u >= low.u && c.u <= high.u && c.v >= low.v && c.v <= high.v);
      }
    }
  }
}

// The estimate for polynomials of third degree must not be below the truth, and not far above.
TEST(Patch, ErrorOfThirdOrderIsABound) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coefficient(-1, 1);
  double tightest = 0;
  for (int round = 0; round < 500; ++round) {
    std::array<double, 8> k;
    std::generate(k.begin(), k.end(), [&] { return coefficient(random); });
    const auto cubic = [&](double x, double y) {
      return 40 * x + k[0] * x * x * x + k[1] * x * x * y + k[2] * x * y * y + k[3] * y * y * y;
    };
    const auto other = [&](double x, double y) {
      return 40 * y + k[4] * x * x * x + k[5] * x * x * y + k[6] * x * y * y + k[7] * y * y * y;
    };
    const Stencil nodes = nodes_of(cubic, other);
    const Patch patch(nodes);
    double worst = 0;
    for (int y = 0; y <= 15; ++y) {
      for (int x = 0; x <= 15; ++x) {
        worst =
            std::max(worst, std::hypot(patch.at(x, y).u - cubic(x / 16.0, y / 16.0) * kOnePixel,
                                       patch.at(x, y).v - other(x / 16.0, y / 16.0) * kOnePixel));
      }
    }
    const double bound = third_order_error(nodes);
    EXPECT_LE(worst, bound + 2);
    tightest = std::max(tightest, worst / bound);
  }
  EXPECT_GT(tightest, 0.7);
}

TEST(Patch, IsTooSteepWhereNeighboursAreTooFarApart) {
  const auto is_too_steep = [](double step, int pixels) {
    const auto steep = [step](double x, double) { return step * x; };
    const auto flat = [](double, double y) { return y; };
    const bool along_u = remap::is_too_steep(nodes_of(steep, flat), pixels);
    EXPECT_EQ(along_u, remap::is_too_steep(nodes_of(flat, steep), pixels));
    return along_u;
  };
  for (const int pixels : {4, 8, 16}) {
    const double most = kSteepest * pixels;
    EXPECT_FALSE(is_too_steep(most, pixels));
    EXPECT_FALSE(is_too_steep(-most, pixels));
    EXPECT_TRUE(is_too_steep(most + 0.01, pixels));
    EXPECT_TRUE(is_too_steep(-most - 0.01, pixels));
  }
  EXPECT_TRUE(is_too_steep(200000, 16));
}

TEST(Patch, KeepsTheSteepestMapThatItMayHave) {
  const auto u = [](double x, double y) { return 256 * x - 250 * y; };
  const auto v = [](double x, double y) { return 100 * x + 250 * y + 3 * x * y; };
  const Patch patch(nodes_of(u, v));
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      EXPECT_NEAR(patch.at(x, y).u / kOnePixel, u(x / 16.0, y / 16.0), 2 / kOnePixel);
      EXPECT_NEAR(patch.at(x, y).v / kOnePixel, v(x / 16.0, y / 16.0), 2 / kOnePixel);
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
