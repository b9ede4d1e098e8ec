#include "app/pipeline/views/frame_pyramids.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>

#include "hal/frame/frame_pool.h"

namespace orbwatch::app {
namespace {

constexpr std::array kFormats{hal::StreamFormat{PixelFormat::Grey, {}, 64, 48, 30},
                              hal::StreamFormat{PixelFormat::Y16, {}, 32, 16, 9}};

hal::Frame plain(const hal::StreamFormat& format, int value) {
  auto buffer = hal::make_frame_pool(format.format, format.width, format.height, 1).acquire();
  std::memset(buffer->memory, value, buffer->capacity);
  return buffer;
}

int first_byte(const Picture& picture) { return static_cast<int>(*picture.planes[0].data); }

TEST(FramePyramids, HaveThePictureAndAsManyMipLevelsAsAreCounted) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(1);
  hal::FrameSet set;
  set.frames = {plain(kFormats[0], 10), plain(kFormats[1], 20)};
  pyramids.build(set, {2, 0}, workers);
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
    pyramids.build(set, {3, 3}, workers);
    for (const Picture& picture : pyramids.pictures(0, 3)) EXPECT_EQ(first_byte(picture), value);
    EXPECT_TRUE(pyramids.pictures(1, 3).empty()) << "no frame of this camera";
  }
  hal::FrameSet none;
  pyramids.build(none, {3, 3}, workers);
  EXPECT_TRUE(pyramids.pictures(0, 3).empty());
}

TEST(FramePyramids, FillOnlyTheLevelsThatAreCounted) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(0);
  hal::FrameSet set;
  set.frames[0] = plain(kFormats[0], 10);
  pyramids.build(set, {3, 0}, workers);
  set.frames[0] = plain(kFormats[0], 30);
  pyramids.build(set, {1, 0}, workers);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[1]), 30);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[2]), 10) << "nobody samples it: left as it was";
}

TEST(FramePyramids, AreExtendedByTheLevelsThatAreMissing) {
  FramePyramids pyramids(kFormats);
  WorkerPool workers(0);
  hal::FrameSet set;
  set.frames[0] = plain(kFormats[0], 10);
  pyramids.build(set, {3, 0}, workers);
  set.frames[0] = plain(kFormats[0], 30);
  pyramids.build(set, {1, 0}, workers);
  std::memset(set.frames[0]->memory, 50, set.frames[0]->capacity);
  pyramids.extend({2, 0}, workers);
  pyramids.extend({1, 0}, workers);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[1]), 30) << "built once";
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[2]), 30);
  EXPECT_EQ(first_byte(pyramids.pictures(0, 3)[3]), 10);
}

}  // namespace
}  // namespace orbwatch::app
