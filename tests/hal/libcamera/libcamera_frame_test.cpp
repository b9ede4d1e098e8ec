// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_frame.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <vector>

#include "tests/hal/frame/udmabuf.h"

namespace orbwatch::hal {
namespace {

constexpr unsigned kPage = 4096;

/// Allocates memory by file descriptor, like software pipelines do.
libcamera::SharedFD make_memory(std::size_t bytes) {
  const int file = ::memfd_create("frame", MFD_CLOEXEC);
  EXPECT_EQ(::ftruncate(file, static_cast<off_t>(bytes)), 0);
  libcamera::SharedFD shared(file);
  ::close(file);
  return shared;
}

TEST(LibcameraFrame, MapsPlanesOfOneMemoryOnceAndShowsWhatTheDeviceWrites) {
  const auto memory = make_memory(2 * kPage);
  const libcamera::FrameBuffer buffer({{memory, 0, kPage}, {memory, kPage, kPage / 2}});
  const auto frame = LibcameraFrame::map(buffer, kLibcameraFormats[0], 60, 64, 64);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ((*frame)->dma_buffers.size(), 1U);
  const Picture& picture = (*frame)->picture;
  ASSERT_EQ(picture.format, PixelFormat::Nv12);
  EXPECT_EQ(picture.planes[1].data - picture.planes[0].data, kPage);
  ASSERT_TRUE((*frame)->begin_read());
  const char sample = 42;
  ASSERT_EQ(::pwrite(memory.get(), &sample, 1, kPage + 3), 1);
  EXPECT_EQ(picture.planes[1].data[3], std::byte{42});
  EXPECT_TRUE((*frame)->end_read());
}

TEST(LibcameraFrame, StaysMappedWhenTheBufferIsGone) {
  std::unique_ptr<LibcameraFrame> frame;
  {
    const auto memory = make_memory(kPage);
    ASSERT_EQ(::pwrite(memory.get(), "last", 4, kPage - 4), 4);
    const libcamera::FrameBuffer buffer({{memory, 0, kPage}});
    auto mapped = LibcameraFrame::map(buffer, *find_format(libcamera::formats::R8), 64, 64, 64);
    ASSERT_TRUE(mapped);
    frame = std::move(*mapped);
  }
  EXPECT_EQ(frame->picture.planes[0].data[kPage - 1], std::byte{'t'});
  void* const page = const_cast<std::byte*>(frame->picture.planes[0].data);
  frame.reset();
  EXPECT_EQ(::msync(page, kPage, MS_ASYNC), -1) << "unmapped with the frame";
}

TEST(MakeBufferLike, HasThePlanesOfTheOtherInMemoryOfItsOwn) {
  const auto luma = make_memory(3 * kPage);
  const auto chroma = make_memory(kPage);
  const libcamera::FrameBuffer own({{luma, 0, kPage}, {luma, kPage, kPage / 2}, {chroma, 0, 100}});
  std::vector<std::size_t> sizes;
  const DmaBufferSource source{"test", [&sizes](std::size_t bytes) {
                                 sizes.push_back(bytes);
                                 return shared_memory().allocate(bytes);
                               }};
  const auto made = make_buffer_like(own, source);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(sizes, (std::vector<std::size_t>{3 * kPage, kPage})) << "as large as the driver's";
  const auto planes = (*made)->planes();
  ASSERT_EQ(planes.size(), 3U);
  for (std::size_t n = 0; n < planes.size(); ++n) {
    EXPECT_EQ(planes[n].offset, own.planes()[n].offset);
    EXPECT_EQ(planes[n].length, own.planes()[n].length);
    EXPECT_NE(planes[n].fd, own.planes()[n].fd);
  }
  EXPECT_EQ(planes[0].fd, planes[1].fd);
  EXPECT_NE(planes[0].fd, planes[2].fd);
  EXPECT_FALSE(make_buffer_like(own, empty_source()));
}

TEST(LibcameraFrame, RefusesBuffersThatAreNone) {
  const auto& grey = *find_format(libcamera::formats::R8);
  const auto memory = make_memory(kPage);
  EXPECT_FALSE(LibcameraFrame::map(libcamera::FrameBuffer({{memory, 0, kPage}}), grey, 64, 65, 64))
      << "too short";
  EXPECT_FALSE(LibcameraFrame::map(libcamera::FrameBuffer({{libcamera::SharedFD(), 0, kPage}}),
                                   grey, 64, 64, 64))
      << "no file";
}

}  // namespace
}  // namespace orbwatch::hal
