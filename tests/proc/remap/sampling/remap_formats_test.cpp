// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/colour/colour_conversion.h"
#include "proc/remap/remap.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using optics::BallModel;
using optics::BallProjection;
using optics::Vec2;
using optics::ViewKind;
using optics::ViewProjection;
using tests::StoredPicture;

constexpr int kSourceWidth = 400, kSourceHeight = 320;

/// A scene with all kinds of tiles: patches, finer tiles, the limb, the picture's border and cut
/// tiles.
struct EveryTileScene {
  ViewProjection view =
      ViewProjection::make({ViewKind::Perspective, {140, 15, 20}, 110, {}, 250, 170}).value();
  BallProjection ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 345).value(),
                                             {{190, 170}, 175, 175, 0}, {})
                            .value();
  CoordinateGrid grid{view, ball, kSourceWidth, kSourceHeight};

  void remap(const StoredPicture& source, StoredPicture& out) const {
    remap::remap(grid, source.as_source(), Interpolation::Bilinear, out.picture,
                 {0, grid.tiles_y()});
  }
};

/// Compares one channel with the same channel remapped alone.
template <class Read>
void expect_channel(const EveryTileScene& scene, const StoredPicture& out, int pixel_bytes,
                    int first, const Read& read) {
  StoredPicture channel(PixelFormat::Grey, kSourceWidth, kSourceHeight),
      alone(PixelFormat::Grey, 250, 170);
  for (int y = 0; y < kSourceHeight; ++y) {
    for (int x = 0; x < kSourceWidth; ++x)
      channel.picture.samples<std::uint8_t>().row(y)[x] = read(x, y);
  }
  scene.remap(channel, alone);
  int differing = 0;
  for (int y = 0; y < 170; ++y) {
    for (int x = 0; x < 250; ++x) {
      const int expected = alone.sample(0, y, x);
      // Undefined pixels are black: 16 in the luminance of limited range.
      if (expected == 0) continue;
      differing += out.sample(0, y, x * pixel_bytes + first) != expected;
    }
  }
  EXPECT_EQ(differing, 0) << "channel " << first;
}

TEST(RemapFormats, EveryChannelIsRemappedAsIfItWereAlone) {
  const EveryTileScene scene;
  struct Case {
    PixelFormat format;
    int pixel_bytes;
    std::array<int, 4> channels;  ///< -1: no more channels
  };
  for (const Case& c :
       {Case{PixelFormat::Rgb, 3, {0, 1, 2, -1}}, Case{PixelFormat::Bgr, 3, {0, 1, 2, -1}},
        Case{PixelFormat::Bgra, 4, {0, 1, 2, 3}}, Case{PixelFormat::Yuyv, 2, {0, -1, -1, -1}},
        Case{PixelFormat::Uyvy, 2, {1, -1, -1, -1}}, Case{PixelFormat::Nv12, 1, {0, -1, -1, -1}},
        Case{PixelFormat::Nv21, 1, {0, -1, -1, -1}}, Case{PixelFormat::I420, 1, {0, -1, -1, -1}}}) {
    SCOPED_TRACE(info(c.format).name);
    StoredPicture source(c.format, kSourceWidth, kSourceHeight, 8), out(c.format, 250, 170, 6);
    source.fill_with_noise(7);
    scene.remap(source, out);
    for (const int first : c.channels) {
      if (first < 0) break;
      expect_channel(scene, out, c.pixel_bytes, first,
                     [&](int x, int y) { return source.sample(0, y, x * c.pixel_bytes + first); });
    }
  }
}

TEST(RemapFormats, SixteenBitsOfAnyDepthAreTheSame) {
  const EveryTileScene scene;
  StoredPicture first(PixelFormat::Y16, kSourceWidth, kSourceHeight),
      out(PixelFormat::Y16, 250, 170);
  first.fill_with_noise(3);
  scene.remap(first, out);
  for (const PixelFormat format : {PixelFormat::Y10, PixelFormat::Y12}) {
    StoredPicture source(format, kSourceWidth, kSourceHeight), same(format, 250, 170);
    source.bytes = first.bytes;
    source.picture =
        MutablePicture::contiguous(format, kSourceWidth, kSourceHeight, source.bytes.data(), 800);
    source.source = source.picture;
    scene.remap(source, same);
    EXPECT_EQ(same.bytes, out.bytes);
  }
}

/// The samples of a plane of chroma: their places in the picture, and the offsets to read them.
struct ChromaPlane {
  int shift_y;
  double offset;  ///< distance of the first sample from the first pixel, px, along a shared axis
  std::array<std::size_t, 2> plane;
  std::array<int, 2> first;
  int step;  ///< bytes from sample to sample
};

ChromaPlane chroma_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::Yuyv:
      return {0, 0, {0, 0}, {1, 3}, 4};
    case PixelFormat::Uyvy:
      return {0, 0, {0, 0}, {0, 2}, 4};
    case PixelFormat::Nv21:
      return {1, 0.5, {1, 1}, {1, 0}, 2};
    case PixelFormat::I420:
      return {1, 0.5, {1, 2}, {0, 0}, 1};
    default:
      return {1, 0.5, {1, 1}, {0, 1}, 2};
  }
}

class SharedChroma : public testing::TestWithParam<PixelFormat> {};

// Compares with the exact projection of the place of the view's chroma sample.
TEST_P(SharedChroma, IsSampledInItsOwnPlane) {
  const EveryTileScene scene;
  const ChromaPlane chroma = chroma_of(GetParam());
  StoredPicture source(GetParam(), kSourceWidth, kSourceHeight), out(GetParam(), 250, 170);
  // The picture is smooth, so that the comparison depends on the place.
  for (std::size_t n = 0; n < 2; ++n) {
    auto& plane = source.picture.planes[chroma.plane[n]];
    for (int y = 0; y < kSourceHeight >> chroma.shift_y; ++y) {
      for (int x = 0; x < kSourceWidth / 2; ++x) {
        plane.data[y * plane.stride + x * chroma.step + chroma.first[n]] =
            static_cast<std::byte>(n == 0 ? x : (y >> (1 - chroma.shift_y)));
      }
    }
  }
  scene.remap(source, out);
  int compared = 0;
  for (int y = 0; y < 170 >> chroma.shift_y; ++y) {
    for (int x = 0; x < 125; ++x) {
      const double v = chroma.shift_y == 1 ? 2 * y + chroma.offset : y;
      const auto direction = scene.view.direction(2 * x + chroma.offset, v);
      const auto p = direction ? scene.ball.pixel(*direction) : std::nullopt;
      if (!p || p->u < 4 || p->v < 4 || p->u > kSourceWidth - 6 || p->v > kSourceHeight - 6)
        continue;
      const Vec2 from_centre{p->u - 190, p->v - 170};
      if (std::hypot(from_centre.u, from_centre.v) > 140) continue;
      const auto at = [&](std::size_t n) {
        return double(out.sample(chroma.plane[n], y, x * chroma.step + chroma.first[n]));
      };
      EXPECT_NEAR(at(0), (p->u - chroma.offset) / 2, 0.6) << x << ' ' << y;
      const double rows = (p->v - chroma.offset) / 2;
      EXPECT_NEAR(at(1), chroma.shift_y == 1 ? rows : p->v / 2 - 0.25, 0.85) << x << ' ' << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

INSTANTIATE_TEST_SUITE_P(All, SharedChroma,
                         testing::Values(PixelFormat::Yuyv, PixelFormat::Uyvy, PixelFormat::Nv12,
                                         PixelFormat::Nv21, PixelFormat::I420),
                         [](const auto& format) {
                           return std::string(orbwatch::info(format.param).name);
                         });

// A view in RGB is the view in the source's own format, converted afterwards.
TEST_P(SharedChroma, IsConvertedAsItWasSampled) {
  const EveryTileScene scene;
  const ChromaPlane chroma = chroma_of(GetParam());
  StoredPicture source(GetParam(), kSourceWidth, kSourceHeight), own(GetParam(), 250, 170);
  StoredPicture rgb(PixelFormat::Rgb, 250, 170), bgr(PixelFormat::Bgr, 250, 170);
  source.fill_with_noise(11);
  scene.remap(source, own);
  scene.remap(source, rgb);
  scene.remap(source, bgr);
  const bool packed = chroma.shift_y == 0;
  const YuvToRgb convert(ColourSpace{});
  int black = 0;
  for (int y = 0; y < 170; ++y) {
    for (int x = 0; x < 250; ++x) {
      const int luminance =
          own.sample(0, y, packed ? 2 * x + (GetParam() == PixelFormat::Uyvy ? 1 : 0) : x);
      const auto shared = [&](std::size_t n) {
        return own.sample(chroma.plane[n], y >> chroma.shift_y,
                          x / 2 * chroma.step + chroma.first[n]);
      };
      std::array<std::uint8_t, 3> expected{};
      convert(luminance, shared(0), shared(1), expected.data());
      const std::array found{rgb.sample(0, y, 3 * x), rgb.sample(0, y, 3 * x + 1),
                             rgb.sample(0, y, 3 * x + 2)};
      if (!is_defined(scene.grid.row(x / kTile, y / kTile, y % kTile)[x % kTile])) expected = {};
      black += expected == std::array<std::uint8_t, 3>{};
      ASSERT_EQ(found, expected) << x << ' ' << y;
      for (int k = 0; k < 3; ++k) ASSERT_EQ(bgr.sample(0, y, 3 * x + k), found[2 - k]);
    }
  }
  EXPECT_GT(black, 100);
}

TEST(RemapFormats, RgbIsReordered) {
  const EveryTileScene scene;
  for (const PixelFormat format : {PixelFormat::Rgb, PixelFormat::Bgr, PixelFormat::Bgra}) {
    StoredPicture source(format, kSourceWidth, kSourceHeight), own(format, 250, 170);
    source.fill_with_noise(5);
    scene.remap(source, own);
    for (const PixelFormat to : {PixelFormat::Rgb, PixelFormat::Bgr}) {
      StoredPicture out(to, 250, 170, 5);
      scene.remap(source, out);
      const int bytes = info(format).channels();
      const bool same_order = (format == PixelFormat::Rgb) == (to == PixelFormat::Rgb);
      for (int y = 0; y < 170; ++y) {
        for (int x = 0; x < 250; ++x) {
          for (int k = 0; k < 3; ++k) {
            const int from = same_order ? k : 2 - k;
            ASSERT_EQ(out.sample(0, y, 3 * x + k), own.sample(0, y, bytes * x + from));
          }
        }
        for (int padding = 750; padding < 755; ++padding) ASSERT_EQ(out.sample(0, y, padding), 0);
      }
    }
  }
}

TEST(RemapFormats, WhatIsUndefinedIsBlack) {
  const EveryTileScene scene;
  const auto expect_byte = [&](PixelFormat format, ColourRange range, std::size_t plane, int byte,
                               int expected) {
    StoredPicture source(format, kSourceWidth, kSourceHeight), out(format, 250, 170);
    source.fill_with_noise(2);
    source.source.colour_space.range = range;
    out.picture.colour_space.range = range;
    scene.remap(source, out);
    int undefined = 0;
    const PlaneInfo& facts = info(format).planes[plane];
    for (int y = 0; y < 170 >> facts.shift_y; ++y) {
      for (int x = 0; x < 250 >> facts.shift_x; ++x) {
        bool any = false;
        for (int j = 0; j < 1 << facts.shift_y; ++j) {
          for (int i = 0; i < 1 << facts.shift_x; ++i) {
            const auto d = scene.view.direction((x << facts.shift_x) + i, (y << facts.shift_y) + j);
            any |= d && scene.ball.pixel(*d);
          }
        }
        if (any) continue;
        ++undefined;
        ASSERT_EQ(out.sample(plane, y, x * facts.samples + byte), expected) << info(format).name;
      }
    }
    EXPECT_GT(undefined, 20);
  };
  expect_byte(PixelFormat::Grey, ColourRange::Full, 0, 0, 0);
  expect_byte(PixelFormat::Rgb, ColourRange::Full, 0, 1, 0);
  expect_byte(PixelFormat::Nv12, ColourRange::Limited, 0, 0, 16);
  expect_byte(PixelFormat::Nv12, ColourRange::Full, 0, 0, 0);
  expect_byte(PixelFormat::Nv12, ColourRange::Limited, 1, 0, 128);
  expect_byte(PixelFormat::I420, ColourRange::Limited, 2, 0, 128);
}

}  // namespace
}  // namespace orbwatch::remap
