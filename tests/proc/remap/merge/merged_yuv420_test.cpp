// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/remap/colour/yuv420.h"
#include "proc/remap/merge/photometric_match.h"
#include "tests/proc/remap/merge/merged_scene.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using tests::StoredPicture;

/// Saturated colours, the neighbours of which differ by little: black, blue, red, yellow, white.
ColourMap::Table heat_table() {
  ColourMap::Table table;
  for (int i = 0; i < 256; ++i) {
    const auto rise = [i](int from) {
      return static_cast<std::uint8_t>(std::clamp(4 * (i - from), 0, 255));
    };
    const int blue = i < 64 ? 4 * i : i < 128 ? 255 - 4 * (i - 64) : 4 * (i - 192);
    table[static_cast<std::size_t>(i)] = {rise(64), rise(128),
                                          static_cast<std::uint8_t>(std::clamp(blue, 0, 255))};
  }
  return table;
}

/// Merged views in I420 against the same views in Rgb, converted.
class MergedYuv420 : public MergedScene {
 protected:
  /// Adds a camera; noise of a 4:2:0 format has only colours that R'G'B' holds, since others are
  /// clipped there and not in YUV.
  Camera& add(double yaw, PixelFormat format, ColourRange range = ColourRange::Limited) {
    MergedScene::add(yaw, format);
    Camera& camera = *cameras.back();
    if (!is_yuv420(format, kJfif)) return camera;
    camera.source.source.colour_space.range = range;
    constexpr int kLeast = 90, kMost = 160, kColour = 24;
    const std::size_t luma = std::size_t{kSide} * kSide;
    for (std::size_t i = 0; i < camera.source.bytes.size(); ++i) {
      const auto noise = std::to_integer<int>(camera.source.bytes[i]);
      camera.source.bytes[i] = static_cast<std::byte>(
          i < luma ? kLeast + noise % (kMost - kLeast) : 128 - kColour + noise % (2 * kColour));
    }
    return camera;
  }

  /// A thermal and two colour cameras; the view turned by chance.
  void surround(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto within = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / static_cast<double>(random.max());
    };
    cameras.clear();
    const optics::YawPitchRoll turned{within(-180, 180), within(-60, 60), within(-180, 180)};
    const bool is_flat = seed % 2 == 0;
    view = ViewProjection::make({is_flat ? ViewKind::Perspective : ViewKind::Equirectangular,
                                 turned,
                                 is_flat ? std::optional(within(50, 120)) : std::nullopt,
                                 {},
                                 kWidth,
                                 kHeight})
               .value();
    const bool is_grey = seed % 3 == 0;
    colours = ColourMap(heat_table(), is_grey ? 20 : 20000, is_grey ? 230 : 45000);
    add(within(-30, 30), is_grey ? PixelFormat::Grey : PixelFormat::Y16);
    add(within(80, 140), seed % 3 == 1 ? PixelFormat::Nv21 : PixelFormat::Nv12);
    add(within(-140, -80), PixelFormat::I420, ColourRange::Full);
    for (const auto& camera : cameras) camera->weight = within(0.1, 2);
    compile();
  }

  /// Renders the view in I420.
  const StoredPicture& render_yuv420(MergeRule rule, const Kernel& kernel = default_kernel()) {
    yuv.emplace(PixelFormat::I420, kWidth, kHeight);
    yuv->picture.colour_space = kJfif;
    target = yuv->picture;
    std::ranges::fill(validity, std::uint8_t{3});
    render(rule, std::nullopt, kernel);
    target.reset();
    return *yuv;
  }

  /// Compares the view with the Rgb one. Rounding before, in and after the mean of luma adds up to
  /// 2.5 in the two ways together, and of chroma, which has a mean more, to 3.5. Chroma mixed by
  /// the mean of four shares differs further, from the mean of four colours, by half of the
  /// difference of these shares.
  void expect_as_rgb(MergeRule rule = MergeRule::Mean) {
    const StoredPicture& mixed = render_yuv420(rule);
    const auto seen = validity;
    std::ranges::fill(validity, std::uint8_t{4});
    render(rule);
    ASSERT_EQ(validity, seen);
    StoredPicture truth(PixelFormat::I420, kWidth, kHeight);
    for (int y = 0; y < kHeight; y += kTile) {
      for (int x = 0; x < kWidth; x += kTile) {
        std::array<std::uint8_t, 3 * kTile * kTile> tile{};
        const TileArea area{x, y, std::min(kTile, kWidth - x), std::min(kTile, kHeight - y)};
        for (int row = 0; row < area.rows; ++row) {
          std::copy_n(&rgb[3 * (kWidth * (y + row) + x)], 3 * area.columns, &tile[3 * kTile * row]);
        }
        write_yuv420({tile.data(), kTile, kTile, 3, 3 * kTile}, truth.picture, area);
      }
    }
    std::vector<std::vector<std::uint8_t>> shares;
    for (std::size_t n = 0; n < cameras.size(); ++n) shares.push_back(weights(n));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_NEAR(mixed.sample(0, y, x), truth.sample(0, y, x), 2) << x << ", " << y;
      }
    }
    for (int y = 0; y < kHeight / 2; ++y) {
      for (int x = 0; x < kWidth / 2; ++x) {
        double tolerance = 3;
        for (const auto& share : shares) {
          const std::uint8_t* const four = &share[2 * static_cast<std::size_t>(y * kWidth + x)];
          const auto [least, most] =
              std::minmax({four[0], four[1], four[kWidth], four[kWidth + 1]});
          tolerance += (most - least) / 2.0;
        }
        ASSERT_NEAR(mixed.sample(1, y, x), truth.sample(1, y, x), tolerance) << x << ", " << y;
        ASSERT_NEAR(mixed.sample(2, y, x), truth.sample(2, y, x), tolerance) << x << ", " << y;
      }
    }
  }

  /// Tiles that several of the cameras see throughout, each with its share.
  int mixed_tiles() const {
    const CoordinateGrid& grid = cameras.front()->grid;
    int count = 0;
    for (int ty = 0; ty < grid.tiles_y(); ++ty) {
      for (int tx = 0; tx < grid.tiles_x(); ++tx) {
        const SourceSet sharing = blend->sharing(tx, ty);
        bool is_seen = std::popcount(sharing) > 1 && blend->adds_up(tx, ty);
        for (std::size_t n = 0; n < cameras.size(); ++n) {
          is_seen &=
              (sharing >> n & 1) == 0 || is_defined_throughout(cameras[n]->grid.tile(tx, ty).kind);
        }
        count += is_seen ? 1 : 0;
      }
    }
    return count;
  }

  std::optional<StoredPicture> yuv;
};

constexpr std::uint32_t kScenes = 12;

TEST_F(MergedYuv420, IsTheRgbViewInOtherViewsByOtherWeights) {
  int mixed = 0;
  for (std::uint32_t seed = 0; seed < kScenes; ++seed) {
    SCOPED_TRACE(seed);
    surround(seed);
    mixed += mixed_tiles();
    ASSERT_NO_FATAL_FAILURE(expect_as_rgb());
  }
  EXPECT_GT(mixed, 1000);
}

TEST_F(MergedYuv420, IsTheRgbViewWithoutSomeOfTheCameras) {
  surround(1);
  for (unsigned delivering = 0; delivering < 8; ++delivering) {
    SCOPED_TRACE(delivering);
    for (std::size_t n = 0; n < 3; ++n) cameras[n]->delivers = (delivering >> n & 1) != 0;
    ASSERT_NO_FATAL_FAILURE(expect_as_rgb());
  }
}

TEST_F(MergedYuv420, IsTheRgbViewOfTheFirstThatSees) {
  for (std::uint32_t seed = 0; seed < kScenes; ++seed) {
    SCOPED_TRACE(seed);
    surround(seed);
    ASSERT_NO_FATAL_FAILURE(expect_as_rgb(MergeRule::First));
  }
}

TEST_F(MergedYuv420, IsTheRgbViewAlsoOfMatchedExposure) {
  PhotometricMatch darker;
  darker.channels = {{{0.5, 0.01}, {0.4, 0}, {0.6, 0.02}}};
  for (const std::size_t matched : {0U, 1U, 2U}) {
    SCOPED_TRACE(matched);
    surround(4);
    render();
    const auto unmatched = rgb;
    cameras[matched]->match.emplace(darker, PixelFormat::Rgb);
    ASSERT_NO_FATAL_FAILURE(expect_as_rgb());
    EXPECT_EQ(rgb == unmatched, matched == 0) << "a colour map keeps its colours";
  }
}

TEST_F(MergedYuv420, IsTheRgbViewAlsoBesideOtherFormats) {
  for (const PixelFormat format : {PixelFormat::Rgb, PixelFormat::Bgra}) {
    SCOPED_TRACE(orbwatch::info(format).name);
    surround(4);
    add(0, format);
    compile();
    ASSERT_NO_FATAL_FAILURE(expect_as_rgb());
  }
}

TEST_F(MergedYuv420, IsWhatTheCountsMeasuredBesideItMean) {
  surround(7);
  StoredPicture beside(PixelFormat::Y16, kWidth, kHeight), truth(PixelFormat::Y16, kWidth, kHeight);
  remap(cameras[0]->grid, cameras[0]->source.as_source(), Interpolation::Bilinear, truth.picture,
        {0, cameras[0]->grid.tiles_y()});
  const auto bytes = render_yuv420(MergeRule::Mean).bytes;
  measured = beside.picture;
  EXPECT_EQ(render_yuv420(MergeRule::Mean).bytes, bytes);
  EXPECT_EQ(beside.bytes, truth.bytes);
}

TEST_F(MergedYuv420, IsTheSameFromEveryKernel) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    surround(seed);
    const auto expected = render_yuv420(MergeRule::Mean, scalar_kernel()).bytes;
    for (const Kernel* kernel : kernels()) {
      EXPECT_EQ(render_yuv420(MergeRule::Mean, *kernel).bytes, expected)
          << kernel->name << ", " << seed;
    }
  }
}

TEST_F(MergedYuv420, OfASourceOfThatKindIsItsOwnPlanes) {
  add(20, PixelFormat::Nv12);
  compile();
  cameras[0]->source.source.colour_space.range = ColourRange::Full;
  StoredPicture yuv(PixelFormat::I420, kWidth, kHeight), own(PixelFormat::Grey, kWidth, kHeight);
  yuv.picture.colour_space = kJfif;
  target = yuv.picture;
  render();
  remap(cameras[0]->grid, luminance_plane(cameras[0]->source)->as_source(), Interpolation::Bilinear,
        own.picture, {0, cameras[0]->grid.tiles_y()});
  int compared = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!is_defined_throughout(cameras[0]->grid.tile(x / kTile, y / kTile).kind)) continue;
      ++compared;
      ASSERT_EQ(yuv.sample(0, y, x), own.sample(0, y, x)) << x << ", " << y;
    }
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace orbwatch::remap
