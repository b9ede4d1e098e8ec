// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/frame_pyramids.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "hal/frame/frame_pool.h"
#include "proc/remap/sampling/pyramid.h"

namespace orbwatch::app::pipeline {
namespace {

constexpr std::array kFormats{hal::StreamFormat{PixelFormat::Grey, {}, 64, 48, 30},
                              hal::StreamFormat{PixelFormat::Y16, {}, 32, 16, 9}};

hal::Frame plain(const hal::StreamFormat& format, int value) {
  auto buffer = hal::make_frame_pool(format.format, format.width, format.height, 1).acquire();
  std::memset(buffer->memory, value, buffer->capacity);
  return buffer;
}

/// Uses of this number of mip levels.
PictureUses halved(int first, int second) {
  PictureUses uses;
  uses[0].mip_levels = first;
  uses[1].mip_levels = second;
  return uses;
}

int first_byte(const Picture& picture) { return static_cast<int>(*picture.planes[0].data); }

TEST(FramePyramids, HaveThePictureAndAsManyMipLevelsAsAreCounted) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(1);
  hal::FrameSet set;
  set.frames = {plain(kFormats[0], 10), plain(kFormats[1], 20)};
  pyramids.build(set, halved(2, 0), workers);
  const auto grey = pyramids.pictures(0, 2);
  ASSERT_EQ(grey.size(), 3U);
  EXPECT_EQ(grey[0].planes[0].data, set.frames[0]->picture.planes[0].data) << "not copied";
  for (std::size_t level = 0; level < 3; ++level) {
    EXPECT_EQ(grey[level].width, 64 >> level);
    EXPECT_EQ(grey[level].height, 48 >> level);
    EXPECT_EQ(first_byte(grey[level]), 10);
  }
  EXPECT_EQ(pyramids.pictures(0, 0).size(), 1U) << "a view that samples none has none";
  EXPECT_EQ(pyramids.pictures(1, 0).size(), 1U);
}

TEST(FramePyramids, AreReplacedWithEachSet) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(0);
  for (const int value : {10, 30}) {
    hal::FrameSet set;
    set.frames[0] = plain(kFormats[0], value);
    pyramids.build(set, halved(3, 3), workers);
    for (const Picture& picture : pyramids.pictures(0, 3)) EXPECT_EQ(first_byte(picture), value);
    EXPECT_TRUE(pyramids.pictures(1, 3).empty()) << "no frame of this camera";
  }
  hal::FrameSet none;
  pyramids.build(none, halved(3, 3), workers);
  EXPECT_TRUE(pyramids.pictures(0, 3).empty());
}

TEST(FramePyramids, FillOnlyTheLevelsThatAreCounted) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(0);
  hal::FrameSet set;
  set.frames[0] = plain(kFormats[0], 10);
  pyramids.build(set, halved(3, 0), workers);
  set.frames[0] = plain(kFormats[0], 30);
  pyramids.build(set, halved(1, 0), workers);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[1]), 30);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[2]), 10) << "nobody samples it: left as it was";
}

TEST(FramePyramids, AreExtendedByTheLevelsThatAreMissing) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(0);
  hal::FrameSet set;
  set.frames[0] = plain(kFormats[0], 10);
  pyramids.build(set, halved(3, 0), workers);
  set.frames[0] = plain(kFormats[0], 30);
  pyramids.build(set, halved(1, 0), workers);
  std::memset(set.frames[0]->memory, 50, set.frames[0]->capacity);
  pyramids.extend(halved(2, 0), workers);
  pyramids.extend(halved(1, 0), workers);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[1]), 30) << "built once";
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[2]), 30);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[3]), 10);
}

hal::Frame noisy(const hal::StreamFormat& format) {
  auto buffer = hal::make_frame_pool(format.format, format.width, format.height, 1).acquire();
  std::minstd_rand random(7);
  for (std::size_t i = 0; i < buffer->capacity; ++i) {
    buffer->memory[i] = static_cast<std::byte>(random() >> 8);
  }
  return buffer;
}

/// Bytes of a level, whose planes are adjacent.
std::vector<std::byte> bytes_of(const Picture& level) {
  const auto row = static_cast<std::size_t>(row_bytes(level.format, level.width));
  const std::byte* first = level.planes[0].data;
  return {first, first + picture_bytes(level.format, row, level.height)};
}

TEST(FramePyramids, AreThoseOfThePictureInOnePieceHoweverTheyAreShared) {
  for (const PixelFormat format : {PixelFormat::Nv12, PixelFormat::I420, PixelFormat::Rgb}) {
    for (const int height : {34, 128, 270, 518}) {
      const std::array formats{hal::StreamFormat{format, {}, 70, height, 30}, kFormats[1]};
      hal::FrameSet set;
      set.frames = {noisy(formats[0]), noisy(formats[1])};
      remap::Pyramid whole(format, 70, height, 3);
      whole.set_source(set.frames[0]->picture);
      whole.fill();
      FramePyramids pyramids(formats);
      WorkerPool workers(3);
      pyramids.build(set, halved(1, 2), workers);
      pyramids.extend(halved(3, 1), workers);
      const auto levels = pyramids.pictures(0, 3);
      ASSERT_EQ(levels.size(), 4U);
      for (std::size_t level = 1; level < 4; ++level) {
        EXPECT_EQ(bytes_of(levels[level]), bytes_of(whole.pictures()[level]))
            << info(format).name << ", " << height << " rows, level " << level;
      }
    }
  }
}

/// Frame of a colour camera and the pyramid made from it. A new frame has noise of its own.
class SharpenedFrames : public testing::Test {
 protected:
  static constexpr int kWidth = 96, kHeight = 80;

  static PictureUses sharpened(double sharpness, const remap::SourceArea& area) {
    PictureUses uses;
    EXPECT_TRUE(uses[0].add(sharpness, area));
    return uses;
  }

  void next_frame() {
    auto buffer = hal::make_frame_pool(PixelFormat::Nv12, kWidth, kHeight, 1).acquire();
    for (std::size_t i = 0; i < buffer->capacity; ++i) {
      buffer->memory[i] = static_cast<std::byte>(random_());
    }
    set.frames[0] = std::move(buffer);
  }

  /// Compares an area of the luminance with the frame's, sharpened by `sharpness`.
  void expect_sharpened(const FramePyramids& pyramids, double sharpness,
                        const remap::SourceArea& area) {
    remap::SharpenedPicture whole(PixelFormat::Nv12, kWidth, kHeight, sharpness);
    whole.set_source(set.frames[0]->picture);
    whole.fill({0, 0, kWidth, kHeight});
    const auto truth = whole.picture().planes[0];
    const auto found = pyramids.pictures(0, 0, sharpness).front().planes[0];
    for (int y = area.top; y < area.bottom; ++y) {
      for (int x = area.left; x < area.right; ++x) {
        ASSERT_EQ(found.data[y * found.stride + x], truth.data[y * truth.stride + x])
            << x << ", " << y;
      }
    }
  }

  static constexpr std::array kColour{hal::StreamFormat{PixelFormat::Nv12, {}, kWidth, kHeight, 30},
                                      hal::StreamFormat{PixelFormat::Y16, {}, 32, 16, 9}};
  hal::FrameSet set;
  WorkerPool workers{2};

 private:
  std::mt19937 random_{1};
};

TEST_F(SharpenedFrames, AreMadeOncePerStrengthForTheAreaOfAllViews) {
  const remap::SourceArea left{4, 6, 30, 70}, right{60, 10, 90, 79};
  PictureUses uses = sharpened(0.8, left);
  ASSERT_TRUE(uses[0].add(0.8, right));
  ASSERT_TRUE(uses[0].add(1.5, right));
  uses[0].mip_levels = 2;
  FramePyramids pyramids(kColour, uses);
  for (int frame = 0; frame < 3; ++frame) {
    next_frame();
    pyramids.build(set, uses, workers);
    expect_sharpened(pyramids, 0.8, united(left, right));
    expect_sharpened(pyramids, 1.5, right);
    const auto as_it_is = pyramids.pictures(0, 2), sharp = pyramids.pictures(0, 2, 0.8);
    EXPECT_EQ(as_it_is[0].planes[0].data, set.frames[0]->picture.planes[0].data);
    ASSERT_EQ(sharp.size(), 3U);
    EXPECT_EQ(sharp[0].planes[1].data, as_it_is[0].planes[1].data) << "the frame's chroma";
    EXPECT_EQ(sharp[2].planes[0].data, as_it_is[2].planes[0].data) << "the frame's mip levels";
    EXPECT_EQ(pyramids.pictures(0, 0, 0.8).size(), 1U);
  }
}

TEST_F(SharpenedFrames, AreExtendedByTheAreaThatIsMissing) {
  const remap::SourceArea measured{20, 20, 50, 40}, shown{10, 30, 90, 72};
  FramePyramids pyramids(kColour, sharpened(0.8, {}));
  next_frame();
  pyramids.build(set, sharpened(0.8, measured), workers);
  expect_sharpened(pyramids, 0.8, measured);
  // An area that is sharpened already is not sharpened again.
  const auto plane = pyramids.pictures(0, 0, 0.8).front().planes[0];
  auto* const known = const_cast<std::byte*>(plane.data) + 25 * plane.stride + 25;
  const std::byte before = *known;
  *known = ~before;
  pyramids.extend(sharpened(0.8, shown), workers);
  EXPECT_EQ(*known, ~before);
  *known = before;
  expect_sharpened(pyramids, 0.8, united(measured, shown));
  next_frame();
  pyramids.build(set, sharpened(0.8, shown), workers);
  expect_sharpened(pyramids, 0.8, shown);
}

TEST_F(SharpenedFrames, AreAsTheyAreWithoutAStrengthOrInAFormatThatIsMeasured) {
  PictureUses uses = sharpened(0.8, {0, 0, kWidth, kHeight});
  ASSERT_TRUE(uses[1].add(0.8, {0, 0, 32, 16}));
  FramePyramids pyramids(kColour, uses);
  next_frame();
  set.frames[1] = plain(kColour[1], 10);
  pyramids.build(set, uses, workers);
  EXPECT_EQ(pyramids.pictures(0, 0, 0.5).front().planes[0].data,
            set.frames[0]->picture.planes[0].data);
  EXPECT_EQ(pyramids.pictures(1, 0, 0.8).front().planes[0].data,
            set.frames[1]->picture.planes[0].data);
}

TEST(PictureUse, HoldsSoManyStrengths) {
  PictureUse use;
  EXPECT_TRUE(use.add(0, {0, 0, 9, 9}));
  EXPECT_TRUE(use.sharpened().empty());
  for (std::size_t n = 1; n <= kMaxSharpnesses; ++n) {
    EXPECT_TRUE(use.add(static_cast<double>(n), {}));
  }
  EXPECT_FALSE(use.add(0.5, {}));
  EXPECT_TRUE(use.add(2, {1, 2, 3, 4})) << "known";
  ASSERT_EQ(use.sharpened().size(), kMaxSharpnesses);
  EXPECT_EQ(use.sharpened()[1].area, (remap::SourceArea{1, 2, 3, 4}));
}

}  // namespace
}  // namespace orbwatch::app::pipeline
