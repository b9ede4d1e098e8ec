// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <linux/dma-buf.h>
#include <sys/ioctl.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/hal/frame/udmabuf.h"
#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/drivers/vivid_device.h"

/// Frames in memory that vivid imports.
namespace orbwatch::hal {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Samples of the last row, where vivid writes no text: bars of colours.
std::vector<std::byte> last_row(const FrameBuffer& frame) {
  const Picture::Plane& plane = frame.picture.planes[0];
  const std::byte* const row = plane.data + plane.stride * (frame.picture.height - 1);
  return {row, row + frame.picture.width * 2};
}

std::string all_buffers() { return std::to_string(kFreeRunningBuffers) + " buffers "; }

std::vector<std::byte> last_row_in_own_memory() {
  CameraRun run(vivid_settings(), {}, [] { return std::vector<DmaBufferSource>(); });
  if (!run.start(kVividRequest)) return {};
  const Frame frame = run.next_frame();
  EXPECT_THAT(run.notice(), HasSubstr("in memory of the driver"));
  return frame ? last_row(*frame) : std::vector<std::byte>();
}

TEST(VividMemory, IsImportedAndHasThePictureOfTheDriversOwn) {
  const auto expected = last_row_in_own_memory();
  ASSERT_FALSE(expected.empty());
  EXPECT_THAT(expected, testing::Contains(testing::Ne(expected[0])));
  Frame held;
  {
    CameraRun run(vivid_settings(), {}, [] { return std::vector{udmabuf()}; });
    ASSERT_TRUE(run.start(kVividRequest));
    // More frames than buffers: each is queued again.
    for (std::size_t n = 0; n < 2 * kFreeRunningBuffers; ++n) {
      held = run.next_frame();
      ASSERT_TRUE(held);
      EXPECT_EQ(last_row(*held), expected);
    }
    EXPECT_EQ(run.notice(), all_buffers() + "from udmabuf");
    EXPECT_FALSE(run.has_reported());
  }
  EXPECT_EQ(last_row(*held), expected) << "of a frame that is held after its camera's end";
}

TEST(VividMemory, IsSynchronisedByTheKernel) {
  V4l2Device device = open_vivid();
  const auto negotiated = negotiate_format(device, {"yuyv", true, kVividRequest});
  ASSERT_TRUE(negotiated) << negotiated.error().detail;
  const auto stream =
      V4l2Stream::start(std::move(device), *negotiated, kFreeRunningBuffers, {udmabuf()});
  ASSERT_TRUE(stream) << stream.error().detail;
  const TimePoint deadline = Clock::now() + std::chrono::seconds(90);
  DeviceResult<std::optional<V4l2Stream::Captured>> captured;
  do {
    captured = (*stream)->next(deadline);
    ASSERT_TRUE(captured) << captured.error().detail;
  } while (!*captured && Clock::now() < deadline);
  ASSERT_TRUE(*captured);
  const auto& buffer = (*captured)->frame->memory_planes.at(0).dma_buffer;
  ASSERT_TRUE(buffer);
  EXPECT_TRUE(buffer->begin_read());
  EXPECT_TRUE(buffer->end_read());
  // The call fails for memory that is not a dma-buf.
  dma_buf_sync sync{DMA_BUF_SYNC_READ | DMA_BUF_SYNC_START};
  EXPECT_EQ(::ioctl(buffer->descriptor(), DMA_BUF_IOCTL_SYNC, &sync), 0);
  sync.flags = DMA_BUF_SYNC_READ | DMA_BUF_SYNC_END;
  EXPECT_EQ(::ioctl(buffer->descriptor(), DMA_BUF_IOCTL_SYNC, &sync), 0);
}

TEST(VividMemory, IsTheNextWhereTheDriverRefusesTheFirst) {
  CameraRun run(vivid_settings(), {}, [] {
    return std::vector{empty_source(), shared_memory(), udmabuf()};
  });
  ASSERT_TRUE(run.start(kVividRequest));
  EXPECT_TRUE(run.next_frame());
  EXPECT_THAT(run.notice(),
              StartsWith(all_buffers() + "from udmabuf (empty: has no memory; shared memory: "));
  EXPECT_THAT(run.notice(), HasSubstr("cannot queue a buffer"));
  EXPECT_FALSE(run.has_reported());
}

// Needs the driver's option allocators=1.
TEST(VividContiguousMemory, IsTheDriversWhereNoOtherIsContiguous) {
  CameraRun run(vivid_settings(), {}, [] { return std::vector{udmabuf()}; });
  ASSERT_TRUE(run.start(kVividRequest));
  EXPECT_TRUE(run.next_frame());
  EXPECT_THAT(run.notice(), StartsWith(all_buffers() + "in memory of the driver"));
  EXPECT_FALSE(run.has_reported());
}

TEST(VividMemory, IsTheDriversWhereItRefusesAll) {
  CameraRun run(vivid_settings(), {}, [] { return std::vector{shared_memory()}; });
  ASSERT_TRUE(run.start(kVividRequest));
  EXPECT_TRUE(run.next_frame());
  EXPECT_THAT(run.notice(), StartsWith(all_buffers() + "in memory of the driver"));
  EXPECT_FALSE(run.has_reported());
}

}  // namespace
}  // namespace orbwatch::hal
