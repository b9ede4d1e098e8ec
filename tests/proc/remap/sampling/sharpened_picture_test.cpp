// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/sharpened_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "proc/optics/rotation.h"
#include "proc/remap/remap.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using tests::StoredPicture;

TEST(CanSharpen, ColourOf8BitAlone) {
  std::vector<PixelFormat> sharpened;
  for (const PixelFormatInfo& facts : kPixelFormats) {
    if (can_sharpen(facts.format)) sharpened.push_back(facts.format);
  }
  EXPECT_EQ(sharpened, (std::vector{PixelFormat::Yuyv, PixelFormat::Uyvy, PixelFormat::Nv12,
                                    PixelFormat::Nv21, PixelFormat::I420, PixelFormat::Rgb,
                                    PixelFormat::Bgr, PixelFormat::Bgra}));
}

/// True if a byte of a pixel in the first plane is sharpened: written down by hand.
bool is_sharpened(PixelFormat format, int byte) {
  if (format == PixelFormat::Yuyv) return byte % 2 == 0;
  if (format == PixelFormat::Uyvy) return byte % 2 == 1;
  return true;
}

class SharpenedPictureOf : public testing::TestWithParam<PixelFormat> {};

TEST_P(SharpenedPictureOf, HasItsAreaSharpenedAndTheSourcesChroma) {
  constexpr int kWidth = 70, kHeight = 12;
  const PixelFormat format = GetParam();
  const int channels = info(format).channels();
  StoredPicture source(format, kWidth, kHeight, 6);
  source.fill_with_noise(1);
  source.source.colour_space = {ColourMatrix::Bt709, ColourRange::Full};
  SharpenedPicture sharpened(format, kWidth, kHeight, 0.8);
  sharpened.set_source(source.source);
  const Picture& picture = sharpened.picture();
  EXPECT_EQ(picture.format, format);
  EXPECT_EQ(picture.colour_space.matrix, ColourMatrix::Bt709);
  EXPECT_EQ(picture.colour_space.range, ColourRange::Full);
  for (std::size_t n = 1; n < info(format).plane_count(); ++n) {
    EXPECT_EQ(picture.planes[n].data, source.source.planes[n].data);
    EXPECT_EQ(picture.planes[n].stride, source.source.planes[n].stride);
  }
  const auto byte = [](const Picture& of, int x, int y) {
    return static_cast<std::uint8_t>(of.planes[0].data[y * of.planes[0].stride + x]);
  };
  const std::int16_t gain = sharpening_gain(0.8);
  for (const SourceArea& area : {SourceArea{0, 0, kWidth, kHeight}, SourceArea{3, 2, 41, 11}}) {
    sharpened.fill(area);
    for (int y = area.top; y < area.bottom; ++y) {
      const auto row = [&](int at) {
        return reinterpret_cast<const std::uint8_t*>(source.source.planes[0].data) +
               std::clamp(at, 0, kHeight - 1) * source.source.planes[0].stride;
      };
      std::vector<std::uint8_t> expected(kWidth * channels);
      sharpen_row({row(y - 1), row(y), row(y + 1), kWidth * channels, channels}, {gain, gain}, 0,
                  kWidth * channels, expected.data());
      for (int x = area.left * channels; x < area.right * channels; ++x) {
        ASSERT_EQ(byte(picture, x, y),
                  is_sharpened(format, x) ? expected[x] : byte(source.source, x, y))
            << x << ", " << y;
      }
    }
  }
}

// No thread writes into another one's rows when several fill areas, and the part that was filled
// before is kept.
TEST_P(SharpenedPictureOf, IsNotWrittenBesideItsArea) {
  constexpr int kWidth = 64, kHeight = 12;
  const int channels = info(GetParam()).channels();
  StoredPicture dark(GetParam(), kWidth, kHeight), bright(GetParam(), kWidth, kHeight);
  std::ranges::fill(bright.bytes, std::byte{200});
  SharpenedPicture sharpened(GetParam(), kWidth, kHeight, 0.8);
  sharpened.set_source(dark.source);
  sharpened.fill({0, 0, kWidth, kHeight});
  sharpened.set_source(bright.source);
  const SourceArea area{6, 3, 40, 9};
  sharpened.fill(area);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth * channels; ++x) {
      const bool is_inside = y >= area.top && y < area.bottom && x >= area.left * channels &&
                             x < area.right * channels;
      const auto& plane = sharpened.picture().planes[0];
      ASSERT_EQ(plane.data[y * plane.stride + x], std::byte(is_inside ? 200 : 0)) << x << ", " << y;
    }
  }
}

optics::BallProjection ball(double yaw) {
  return optics::BallProjection::make(
             optics::BallModel::make(optics::BallModel::Kind::Exact, 345).value(),
             {{159.5, 121.5}, 110, 110, 0}, optics::rotation({yaw, 20, 30}))
      .value();
}

/// A view of a source of 320x240 pixels by remap(), with mip levels.
std::vector<std::byte> remapped(const CoordinateGrid& grid, const Picture& source,
                                Interpolation interpolation) {
  Pyramid pyramid(source.format, source.width, source.height, kMaxLevel);
  pyramid.set_source(source);
  pyramid.fill();
  StoredPicture out(PixelFormat::Rgb, grid.width(), grid.height());
  remap(grid, pyramid.pictures(), interpolation, out.picture, {0, grid.tiles_y()});
  return out.bytes;
}

// Noise beside the area would show.
TEST_P(SharpenedPictureOf, ViewsReadNothingBesideTheirSampledArea) {
  constexpr int kWidth = 320, kHeight = 240;
  using optics::ViewKind;
  StoredPicture black(GetParam(), kWidth, kHeight), framed(GetParam(), kWidth, kHeight);
  const auto clear = [](const StoredPicture& stored, const SourceArea& area) {
    for (std::size_t n = 0; n < info(GetParam()).plane_count(); ++n) {
      const PlaneInfo& plane = info(GetParam()).planes[n];
      const bool is_chroma_alone = n > 0;
      for (int y = 0; y < kHeight >> plane.shift_y; ++y) {
        std::byte* const row = stored.picture.planes[n].data + y * stored.picture.planes[n].stride;
        const bool is_inside = y >= area.top && y < area.bottom;
        const int left = is_chroma_alone ? 0 : area.left;
        const int right = is_chroma_alone ? kWidth >> plane.shift_x : area.right;
        if (!is_chroma_alone && !is_inside) continue;
        std::fill(row + left * plane.samples, row + right * plane.samples, std::byte{128});
      }
    }
  };
  clear(black, {0, 0, kWidth, kHeight});
  int smaller = 0;
  for (const optics::ViewSpec& spec :
       {optics::ViewSpec{ViewKind::Perspective, {}, 60, {}, 200, 150},
        optics::ViewSpec{ViewKind::Perspective, {70, 20, 45}, 30, {}, 97, 61},
        optics::ViewSpec{ViewKind::Perspective, {30, -20, 10}, 100, {}, 60, 40},
        optics::ViewSpec{ViewKind::Perspective, {10, 0, 10}, 90, {}, 16, 9},
        optics::ViewSpec{ViewKind::Equirectangular, {}, {}, {}, 400, 200},
        optics::ViewSpec{ViewKind::Fisheye, {50, 0, 0}, 120, {}, 300, 300}}) {
    const auto view = optics::ViewProjection::make(spec).value();
    for (const double yaw : {0.0, 140.0}) {
      const CoordinateGrid grid(view, ball(yaw), kWidth, kHeight);
      const SourceArea area = grid.sampled_area();
      smaller += (area.right - area.left) * (area.bottom - area.top) < kWidth * kHeight / 2;
      framed.fill_with_noise(1);
      clear(framed, area);
      for (const auto interpolation :
           {Interpolation::Area, Interpolation::Bilinear, Interpolation::Nearest}) {
        ASSERT_EQ(remapped(grid, framed.source, interpolation),
                  remapped(grid, black.source, interpolation))
            << spec.width << "x" << spec.height << " from " << yaw;
      }
    }
  }
  EXPECT_GE(smaller, 3) << "else nothing was tried";
}

INSTANTIATE_TEST_SUITE_P(All, SharpenedPictureOf,
                         testing::Values(PixelFormat::Yuyv, PixelFormat::Uyvy, PixelFormat::Nv12,
                                         PixelFormat::Nv21, PixelFormat::I420, PixelFormat::Rgb,
                                         PixelFormat::Bgr, PixelFormat::Bgra),
                         [](const auto& test) {
                           return std::string(orbwatch::info(test.param).name);
                         });

}  // namespace
}  // namespace orbwatch::remap
