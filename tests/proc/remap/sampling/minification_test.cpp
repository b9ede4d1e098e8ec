// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "proc/optics/vec.h"
#include "proc/remap/remap.h"
#include "proc/remap/sampling/pyramid.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::Vec2;
using optics::ViewKind;
using optics::ViewProjection;
using tests::StoredPicture;

constexpr int kPaintedSide = 1200;

BallProjection centred_ball() {
  return BallProjection::make(BallModel::make(BallModel::Kind::Exact, 348.5).value(),
                              {{599.5, 599.5}, 590, 590, 0}, {})
      .value();
}

/// Detail down to single pixels: fine lines, edges and noise.
void paint(StoredPicture& picture) {
  std::mt19937 random(1);
  for (int y = 0; y < kPaintedSide; ++y) {
    for (int x = 0; x < kPaintedSide; ++x) {
      const double rings = std::sin(0.0021 * ((x - 600) * (x - 600) + (y - 600) * (y - 600)));
      const bool bright = (x / 37 + y / 23) % 2 != 0;
      const double value = 110 + 50 * rings + (bright ? 50 : 0) + static_cast<int>(random() % 40);
      picture.picture.samples<std::uint8_t>().row(y)[x] = static_cast<std::uint8_t>(value);
    }
  }
}

double bilinear(const StoredPicture& picture, const Vec2& p) {
  const auto at = [&](int u, int v) {
    return double(
        picture.sample(0, std::clamp(v, 0, kPaintedSide - 1), std::clamp(u, 0, kPaintedSide - 1)));
  };
  const int u = static_cast<int>(std::floor(p.u)), v = static_cast<int>(std::floor(p.v));
  const double wu = p.u - u, wv = p.v - v;
  return (at(u, v) * (1 - wu) + at(u + 1, v) * wu) * (1 - wv) +
         (at(u, v + 1) * (1 - wu) + at(u + 1, v + 1) * wu) * wv;
}

struct Quality {
  double ours, single;  ///< PSNR in dB; `single` is for one bilinear sample per pixel
};

/// Compares with the mean of 8x8 samples of the exact projection, at every second pixel.
Quality quality(int width, double roll) {
  const auto ball = centred_ball();
  const auto view =
      ViewProjection::make({ViewKind::Perspective, {10, -5, roll}, 80, {}, width, width}).value();
  const CoordinateGrid grid(view, ball, kPaintedSide, kPaintedSide);
  StoredPicture source(PixelFormat::Grey, kPaintedSide, kPaintedSide),
      out(PixelFormat::Grey, width, width);
  paint(source);
  Pyramid pyramid(PixelFormat::Grey, kPaintedSide, kPaintedSide, grid.pyramid_levels());
  pyramid.set_source(source.picture);
  pyramid.fill();
  remap(grid, pyramid.pictures(), Interpolation::Area, out.picture, {0, grid.tiles_y()});
  double ours = 0, single = 0, count = 0;
  for (int y = 0; y < width; y += 2) {
    for (int x = 0; x < width; x += 2, ++count) {
      constexpr int kSamples = 8;
      double truth = 0;
      for (int j = 0; j < kSamples; ++j) {
        for (int i = 0; i < kSamples; ++i) {
          const auto direction =
              view.direction(x + (i + 0.5) / kSamples - 0.5, y + (j + 0.5) / kSamples - 0.5);
          truth += bilinear(source, ball.pixel(*direction).value());
        }
      }
      truth /= kSamples * kSamples;
      const double one = bilinear(source, ball.pixel(*view.direction(x, y)).value());
      ours += std::pow(out.sample(0, y, x) - truth, 2);
      single += std::pow(one - truth, 2);
    }
  }
  const auto psnr = [&](double sum) { return 10 * std::log10(255 * 255 * count / sum); };
  return {psnr(ours), psnr(single)};
}

// The view spans about 410 source pixels.
TEST(Minification, DoesNotAlias) {
  for (const double roll : {0.0, 33.0}) {
    for (const auto& [width, least] :
         {std::pair{240, 36.0}, {160, 36.0}, {100, 33.0}, {64, 27.0}}) {
      const Quality q = quality(width, roll);
      EXPECT_GE(q.ours, least) << width << " roll " << roll;
      // Along an axis with steps up to kLongestStep, one sample is all there is.
      EXPECT_GE(q.ours, q.single + 4) << width << " roll " << roll;
      RecordProperty("psnr_" + std::to_string(width), std::to_string(q.ours));
    }
  }
}

TEST(Minification, ChangesNothingWhereTheViewIsLarger) {
  const auto view =
      ViewProjection::make({ViewKind::Perspective, {10, -5, 3}, 60, {}, 700, 500}).value();
  const CoordinateGrid grid(view, centred_ball(), kPaintedSide, kPaintedSide);
  EXPECT_EQ(grid.levels(), 0);
  EXPECT_EQ(grid.pyramid_levels(), 0);
}

TEST(Pyramid, LevelsAreMeans) {
  for (const PixelFormat format : {PixelFormat::Grey, PixelFormat::Rgb, PixelFormat::Bgra,
                                   PixelFormat::Nv12, PixelFormat::I420}) {
    SCOPED_TRACE(info(format).name);
    StoredPicture source(format, 76, 52, 4);
    source.fill_with_noise(9);
    Pyramid pyramid(format, 76, 52, 2);
    pyramid.set_source(source.picture);
    pyramid.fill();
    ASSERT_EQ(pyramid.levels(), 2);
    const Picture& half = pyramid.pictures()[1];
    ASSERT_EQ(half.width, 38);
    ASSERT_EQ(half.height, 26);
    for (std::size_t n = 0; n < info(format).plane_count(); ++n) {
      const PlaneInfo& plane = info(format).planes[n];
      for (int y = 0; y < half.height >> plane.shift_y; ++y) {
        for (int x = 0; x < (half.width >> plane.shift_x) * plane.samples; ++x) {
          const int left = x / plane.samples * 2 * plane.samples + x % plane.samples;
          const int sum = source.sample(n, 2 * y, left) + source.sample(n, 2 * y + 1, left) +
                          source.sample(n, 2 * y, left + plane.samples) +
                          source.sample(n, 2 * y + 1, left + plane.samples);
          const auto* row = half.planes[n].data + y * half.planes[n].stride;
          ASSERT_EQ(static_cast<int>(row[x]), (sum + 2) / 4) << n << ": " << x << ' ' << y;
        }
      }
    }
  }
}

TEST(Pyramid, SharesItsRowsAndLeavesOutWhatWouldBeTooSmall) {
  StoredPicture source(PixelFormat::Yuyv, 40, 18);
  source.fill_with_noise(4);
  Pyramid whole(PixelFormat::Yuyv, 40, 18, kMaxLevel), shared(PixelFormat::Yuyv, 40, 18, kMaxLevel);
  EXPECT_EQ(whole.levels(), 3);
  EXPECT_EQ(Pyramid(PixelFormat::Nv12, 8, 8, kMaxLevel).levels(), 2);
  EXPECT_EQ(Pyramid(PixelFormat::Grey, 3, 3, kMaxLevel).levels(), 0);
  whole.set_source(source.picture);
  shared.set_source(source.picture);
  whole.fill();
  for (int level = 1; level <= shared.levels(); ++level) {
    for (int pair = shared.row_pairs(level) - 1; pair >= 0; --pair) {
      shared.fill(level, pair, pair + 1);
    }
    const Picture &a = whole.pictures()[level], &b = shared.pictures()[level];
    EXPECT_TRUE(std::equal(a.planes[0].data, a.planes[0].data + a.planes[0].stride * a.height,
                           b.planes[0].data))
        << level;
  }
}

}  // namespace
}  // namespace orbwatch::remap
