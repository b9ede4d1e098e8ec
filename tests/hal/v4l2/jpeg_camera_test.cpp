// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "hal/jpeg/jpeg_decoder.h"
#include "tests/hal/v4l2/drivers/ball_pictures.h"
#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/fake_device.h"

/// A camera that sends JPEG.
namespace orbwatch::hal {
namespace {

const std::vector<std::byte> kSent = ball_jpeg(0);
const V4l2Settings kSettings{.device = tests::kFakeDevice, .pixel_format = "mjpeg"};

class JpegCamera : public testing::TestWithParam<bool> {
 protected:
  JpegCamera() { tests::connect({V4L2_PIX_FMT_MJPEG, {{kBallWidth, kBallHeight}}, {}, kSent}); }
};

TEST_P(JpegCamera, KeepsTheDataBesideThePixelsOnRequest) {
  const bool is_kept = GetParam();
  CameraRun run(kSettings);
  ASSERT_TRUE(run.start({.keeps_jpeg = is_kept}));
  EXPECT_EQ(run.format().has_jpeg, is_kept);
  for (int n = 0; n < 20; ++n) {
    const Frame frame = run.next_frame();
    ASSERT_TRUE(frame);
    EXPECT_TRUE(std::ranges::equal(frame->jpeg, is_kept ? kSent : std::vector<std::byte>()));
    FramePool pool = make_frame_pool(PixelFormat::Nv12, kBallWidth, kBallHeight, 1);
    const auto expected = pool.acquire();
    const auto target = MutablePicture::contiguous(PixelFormat::Nv12, kBallWidth, kBallHeight,
                                                   expected->memory, kBallWidth);
    ASSERT_TRUE(JpegDecoder().decode_nv12(kSent, target));
    EXPECT_TRUE(std::equal(expected->memory, expected->memory + expected->capacity, frame->memory));
  }
}
INSTANTIATE_TEST_SUITE_P(OfRequest, JpegCamera, testing::Bool());

}  // namespace
}  // namespace orbwatch::hal
