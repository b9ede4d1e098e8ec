// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/plane_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "proc/remap/compiler/tolerance.h"
#include "tests/proc/remap/kernel/random_patch.h"

namespace orbwatch::remap {
namespace {

constexpr std::array kAllLayouts{Layout::One8,  Layout::Two8,        Layout::Three8,
                                 Layout::Four8, Layout::FirstOfTwo8, Layout::OddOfFour8,
                                 Layout::One16, Layout::Three16};

/// White noise that ends at the end of its heap block: sanitizers detect reads beyond it.
struct Source {
  std::vector<std::uint8_t> bytes;
  SourcePlane plane;

  Source(std::mt19937& random, Layout layout, int width, int height, int padding) {
    const int row = width * info(layout).pixel_bytes;
    const std::ptrdiff_t stride = row + padding;
    bytes.resize(static_cast<std::size_t>((height - 1) * stride + row));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    plane = {bytes.data(), stride, width, height};
  }

  double sample(Layout layout, int u, int v, int k) const {
    const LayoutInfo& facts = info(layout);
    const auto* pixel = plane.data + std::clamp(v, 0, plane.height - 1) * plane.stride +
                        std::clamp(u, 0, plane.width - 1) * facts.pixel_bytes;
    const int at = (facts.first + k * facts.every) * facts.sample_bytes;
    if (facts.sample_bytes == 1) return pixel[at];
    std::uint16_t value = 0;
    std::memcpy(&value, pixel + at, sizeof value);
    return value / 257.0;
  }
};

/// A target and the pixels around it, which must not change.
struct Target {
  static constexpr std::uint8_t kCanary = 0xa5;
  static constexpr int kMargin = 64;
  std::vector<std::uint8_t> bytes;
  TargetPlane plane;

  Target(Layout layout, int columns, int rows)
      : bytes(static_cast<std::size_t>(rows * stride(layout, columns) + 2 * kMargin), kCanary),
        plane{bytes.data() + kMargin, stride(layout, columns), columns, rows} {}

  double sample(Layout layout, int x, int y, int k) const {
    const auto* at = plane.data + y * plane.stride + x * info(layout).out_bytes() +
                     k * info(layout).sample_bytes;
    if (info(layout).sample_bytes == 1) return *at;
    std::uint16_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return value / 257.0;
  }

  void expect_canaries(Layout layout) const {
    const int row = plane.columns * info(layout).out_bytes();
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(n) - kMargin;
      const bool inside = at >= 0 && at < plane.rows * plane.stride && at % plane.stride < row;
      if (!inside) {
        ASSERT_EQ(bytes[n], kCanary) << at;
      }
    }
  }

 private:
  static std::ptrdiff_t stride(Layout layout, int columns) {
    return std::ptrdiff_t{columns} * info(layout).out_bytes() + 5;
  }
};

/// Bilinear interpolation in double precision, with the outermost pixels repeated.
double bilinear(const Source& source, Layout layout, const Coordinate& c, int k) {
  const double u = c.u / kOnePixel, v = c.v / kOnePixel;
  const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
  const auto row = [&](int y) {
    const double a = source.sample(layout, left, y, k), b = source.sample(layout, left + 1, y, k);
    return a + (b - a) * (u - left);
  };
  return row(top) + (row(top + 1) - row(top)) * (v - top);
}

/// A patch of any steepness about the source's middle, its border or beyond.
Patch patch_near(std::mt19937& random, const SourcePlane& source, double slope) {
  const Patch anywhere = tests::RandomPatch(random, {slope, slope / 50}).patch();
  Quadratic u = anywhere.u(), v = anywhere.v();
  const auto within = [&random](int size) {
    return static_cast<std::int64_t>(std::uniform_real_distribution(-3.0, size + 2.0)(random) *
                                     (1 << 24));
  };
  u.value = within(source.width);
  v.value = within(source.height);
  return {u, v};
}

TEST(PointSampling, InterpolatesEveryLayoutLikeDoublePrecision) {
  std::mt19937 random(1);
  for (const Layout layout : kAllLayouts) {
    double squares = 0, worst = 0;
    int count = 0;
    for (int round = 0; round < 60; ++round) {
      const Source source(random, layout, 50, 40, round % 4);
      const Patch patch = patch_near(random, source.plane, 2);
      Target target(layout, kTile, kTile);
      sample_points(*kernels().front(), layout, patch, source.plane, target.plane);
      for (int y = 0; y < kTile; ++y) {
        for (int x = 0; x < kTile; ++x) {
          for (int k = 0; k < info(layout).samples; ++k, ++count) {
            const double error =
                target.sample(layout, x, y, k) - bilinear(source, layout, patch.at(x, y), k);
            squares += error * error;
            worst = std::max(worst, std::abs(error));
          }
        }
      }
    }
    EXPECT_LT(std::sqrt(squares / count), 1.0) << static_cast<int>(layout);
    EXPECT_LT(worst, 5.0) << static_cast<int>(layout);
  }
}

TEST(PointSampling, IsTheSameForEveryKernel) {
  std::mt19937 random(2);
  constexpr std::array kSides{16, 8, 4, 2};
  for (const Layout layout : kAllLayouts) {
    for (int round = 0; round < 200; ++round) {
      const auto any = [&random](int count) { return static_cast<int>(random() % count); };
      const Source source(random, layout, 1 + any(40), 1 + any(40), any(9));
      const Patch patch = patch_near(random, source.plane, round % 3 ? 6 : 0.5);
      const int columns = kSides[any(4)], rows = kSides[any(4)];
      std::vector<std::uint8_t> expected;
      for (const Kernel* kernel : kernels()) {
        Target target(layout, columns, rows);
        sample_points(*kernel, layout, patch, source.plane, target.plane);
        target.expect_canaries(layout);
        if (expected.empty()) expected = target.bytes;
        ASSERT_EQ(target.bytes, expected)
            << kernel->name << ", layout " << static_cast<int>(layout) << ", round " << round;
      }
    }
  }
}

TEST(PointSampling, TakesCoordinatesAsTheyAreAndMakesUndefinedOnesBlack) {
  std::mt19937 random(3);
  for (const Layout layout : kAllLayouts) {
    const Source source(random, layout, 30, 20, 3);
    CoordinateTile tile;
    for (CoordinateRow& row : tile) {
      for (Coordinate& c : row) {
        c = {static_cast<std::int32_t>(random() % (34 << kFractionBits)) - (2 << kFractionBits),
             static_cast<std::int32_t>(random() % (24 << kFractionBits)) - (2 << kFractionBits)};
        if (random() % 5 == 0) c = {random() % 2 ? kBlind : kOutside, 0};
      }
    }
    for (const int columns : {16, 8}) {
      for (const Kernel* kernel : kernels()) {
        Target target(layout, columns, 8);
        sample_points(*kernel, layout, tile, 77, source.plane, target.plane);
        for (int y = 0; y < 8; ++y) {
          for (int x = 0; x < columns; ++x) {
            for (int k = 0; k < info(layout).samples; ++k) {
              const double sample = target.sample(layout, x, y, k);
              if (is_defined(tile[y][x])) {
                ASSERT_NEAR(sample, bilinear(source, layout, tile[y][x], k), 5) << kernel->name;
              } else {
                ASSERT_EQ(sample, 77) << kernel->name;
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
