// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/blob_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace orbwatch::signals {
namespace {

TEST(Cell, AllAboveIsTheSquare) {
  const Piece piece = piece_above({1, 2, 3, 4}), square;
  EXPECT_DOUBLE_EQ(piece.area, 1);
  EXPECT_DOUBLE_EQ(piece.u, 0.5);
  EXPECT_NEAR(piece.uu, square.uu, 1e-15);
  EXPECT_NEAR(piece.uv, 0, 1e-15);
}

/// A plane's border is straight, so the piece is exact: compared with counting small squares.
TEST(Cell, UnderAPlaneIsExact) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  constexpr int kSteps = 400;
  int cut = 0;
  for (int round = 0; round < 200; ++round) {
    const double a = unit(random), b = unit(random), c = 0.7 * unit(random);
    const auto height = [&](double u, double v) { return c + a * (u - 0.5) + b * (v - 0.5); };
    double n = 0, u1 = 0, v1 = 0, uu = 0, vv = 0, uv = 0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
        if (height(u, v) < 0) continue;
        ++n;
        u1 += u, v1 += v, uu += u * u, vv += v * v, uv += u * v;
      }
    }
    const double area = n / kSteps / kSteps;
    if (area < 0.02 || area > 0.98) continue;
    ++cut;
    const Piece piece = piece_above({height(0, 0), height(1, 0), height(1, 1), height(0, 1)});
    EXPECT_NEAR(piece.area, area, 3e-3);
    EXPECT_NEAR(piece.u, u1 / n, 3e-3);
    EXPECT_NEAR(piece.v, v1 / n, 3e-3);
    EXPECT_NEAR(piece.uu, uu / n - u1 * u1 / n / n, 1e-3);
    EXPECT_NEAR(piece.vv, vv / n - v1 * v1 / n / n, 1e-3);
    EXPECT_NEAR(piece.uv, uv / n - u1 * v1 / n / n, 1e-3);
  }
  EXPECT_GT(cut, 50);
}

TEST(Cell, JoinsOppositeCorners) {
  EXPECT_NEAR(piece_above({1, -1, 1, -1}).area, 0.75, 1e-12);
  EXPECT_NEAR(piece_above({1, -1, -1, -1}).area, 0.125, 1e-12);
}

TEST(Cell, ACornerAtTheThresholdCoversNothing) { EXPECT_EQ(piece_above({0, -1, -1, -1}).area, 0); }

}  // namespace
}  // namespace orbwatch::signals
