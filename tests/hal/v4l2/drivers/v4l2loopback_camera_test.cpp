// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <optional>

#include "hal/v4l2/device/v4l2_list.h"
#include "tests/hal/v4l2/drivers/ball_pictures.h"
#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/drivers/feeder.h"

/// Pictures of a mirror ball, fed into v4l2loopback and captured through the camera.
namespace orbwatch::hal {
namespace {

constexpr StreamRequest kRequest{.width = kBallWidth, .height = kBallHeight};
constexpr std::size_t kPixels = std::size_t{kBallWidth} * kBallHeight;

std::string loopback() {
  for (const CameraEntry& camera : list_v4l2_cameras()) {
    if (camera.model == "orbwatch") return camera.paths.back();
  }
  // The node is not a camera until a program feeds it; the scenario provides its path.
  const char* const path = std::getenv("ORBWATCH_V4L2LOOPBACK");
  return path ? path : "no v4l2loopback";
}

struct Fed {
  const char* pixel_format;
  std::uint32_t fourcc;
  int bytes;    ///< bytes of a sample
  int columns;  ///< samples of a row
  PixelFormat captured;
};

Feeder::Pictures pictures(const Fed& fed) {
  Feeder::Pictures all;
  for (int n = 0; n < 3; ++n) {
    all.push_back(ball_samples(n, fed.bytes, fed.columns, kBallHeight));
  }
  return all;
}

class LoopbackFormat : public testing::TestWithParam<Fed> {};

TEST_P(LoopbackFormat, ComesOutBitByBit) {
  const auto fed = pictures(GetParam());
  const Feeder feeder(loopback(), GetParam().fourcc, kBallWidth, kBallHeight, fed);
  CameraRun run({loopback(), GetParam().pixel_format, false});
  ASSERT_TRUE(run.start(kRequest));
  for (int n = 0; n < 5; ++n) {
    const Frame frame = run.next_frame();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->picture.format, GetParam().captured);
    const auto& plane = frame->picture.planes[0];
    const auto is_this = [&](const std::vector<std::byte>& picture) {
      const std::size_t row = picture.size() / kBallHeight;
      for (int y = 0; y < kBallHeight; ++y) {
        const auto* const truth = picture.data() + static_cast<std::size_t>(y) * row;
        if (!std::equal(truth, truth + row, plane.data + y * plane.stride)) return false;
      }
      return true;
    };
    EXPECT_EQ(std::count_if(fed.begin(), fed.end(), is_this), 1) << "frame " << n;
  }
}
INSTANTIATE_TEST_SUITE_P(
    OfDriver, LoopbackFormat,
    testing::Values(Fed{"grey", V4L2_PIX_FMT_GREY, 1, kBallWidth, PixelFormat::Grey},
                    Fed{"yuyv", V4L2_PIX_FMT_YUYV, 1, 2 * kBallWidth, PixelFormat::Yuyv},
                    Fed{"y16", V4L2_PIX_FMT_Y16, 2, kBallWidth, PixelFormat::Y16},
                    Fed{"rggb8", V4L2_PIX_FMT_SRGGB8, 1, kBallWidth, PixelFormat::Grey}),
    [](const auto& fed) { return std::string(fed.param.pixel_format); });

/// Largest differences of a captured picture's luminance and of its chroma to picture n.
std::array<int, 2> differences(const Picture& picture, int n) {
  const auto luma = ball_samples(n, 1, kBallWidth, kBallHeight);
  const auto sample = [&](std::size_t plane, int column, int row) {
    return std::to_integer<int>(
        picture.planes[plane].data[row * picture.planes[plane].stride + column]);
  };
  std::array<int, 2> most{};
  for (int y = 0; y < kBallHeight; ++y) {
    for (int x = 0; x < kBallWidth; ++x) {
      const int truth = std::to_integer<int>(luma[static_cast<std::size_t>(y * kBallWidth + x)]);
      most[0] = std::max(most[0], std::abs(sample(0, x, y) - truth));
      if (picture.format != PixelFormat::Nv12) continue;
      const int chroma = x % 2 == 0 ? 200 - x / 2 : 60 + y / 2;
      most[1] = std::max(most[1], std::abs(sample(1, x, y / 2) - chroma));
    }
  }
  return most;
}

class LoopbackJpeg : public testing::TestWithParam<bool> {};

TEST_P(LoopbackJpeg, ShowsThePictureThatWasCompressed) {
  const bool colour = GetParam();
  const Feeder feeder(loopback(), V4L2_PIX_FMT_MJPEG, kBallWidth, kBallHeight,
                      {ball_jpeg(0), ball_jpeg(1), ball_jpeg(2)});
  CameraRun run({loopback(), "mjpeg", colour});
  ASSERT_TRUE(run.start(kRequest));
  for (int n = 0; n < 3; ++n) {
    const Frame frame = run.next_frame();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->picture.format, colour ? PixelFormat::Nv12 : PixelFormat::Grey);
    std::array<int, 2> least{255, 255};
    for (int fed = 0; fed < 3; ++fed) least = std::min(least, differences(frame->picture, fed));
    EXPECT_LE(least[0], 16);  // at the ball's edge; a different picture differs by 100
    EXPECT_LE(least[1], 4);
  }
}
INSTANTIATE_TEST_SUITE_P(OfDriver, LoopbackJpeg, testing::Bool());

TEST(LoopbackFaults, DamagedJpegPicturesAreWithheldAndReported) {
  Feeder feeder(loopback(), V4L2_PIX_FMT_MJPEG, kBallWidth, kBallHeight, {ball_jpeg(0)});
  CameraRun run({loopback(), "mjpeg", true});
  ASSERT_TRUE(run.start(kRequest));
  ASSERT_TRUE(run.next_frame());
  auto cut = ball_jpeg(1);
  cut.resize(cut.size() / 2);
  feeder.show({cut});
  EXPECT_TRUE(run.reports(Fault::CorruptFrame));
  feeder.show({ball_jpeg(1)});
  EXPECT_TRUE(run.reports(Fault::None));
}

TEST(LoopbackFaults, AJpegPictureWithoutItsEndIsDeliveredAndCounted) {
  auto picture = ball_jpeg(0);
  constexpr std::size_t kEndMarkerBytes = 2;
  picture.resize(picture.size() - kEndMarkerBytes);
  const Feeder feeder(loopback(), V4L2_PIX_FMT_MJPEG, kBallWidth, kBallHeight, {picture});
  CameraRun run({loopback(), "mjpeg", true});
  ASSERT_TRUE(run.start(kRequest));
  EXPECT_TRUE(run.next_frame());
  EXPECT_GE(run.camera().quality().flawed, 1U);
  EXPECT_FALSE(run.has_reported());
}

TEST(LoopbackFaults, ShortFramesAreWithheldAndReported) {
  const auto whole = ball_samples(0, 1, kBallWidth, kBallHeight);
  Feeder feeder(loopback(), V4L2_PIX_FMT_GREY, kBallWidth, kBallHeight, {whole});
  CameraRun run({loopback(), "grey", true});
  ASSERT_TRUE(run.start(kRequest));
  ASSERT_TRUE(run.next_frame());
  feeder.show({{whole.begin(), whole.begin() + kPixels / 3}});
  EXPECT_TRUE(run.reports(Fault::CorruptFrame));
  feeder.show({whole});
  EXPECT_TRUE(run.reports(Fault::None));
}

TEST(LoopbackFaults, SilenceIsAStallUntilFramesComeAgain) {
  Feeder feeder(loopback(), V4L2_PIX_FMT_GREY, kBallWidth, kBallHeight,
                {ball_samples(0, 1, kBallWidth, kBallHeight)});
  CameraRun run({loopback(), "grey", true});
  ASSERT_TRUE(run.start(kRequest));
  for (int n = 0; n < 2; ++n) {
    ASSERT_TRUE(run.next_frame());
    feeder.pause();
    EXPECT_TRUE(run.reports(Fault::Stalled));
    feeder.resume();
  }
  EXPECT_TRUE(run.reports(Fault::None));
}

TEST(LoopbackFaults, AnotherFormatAfterAReturnIsRefusedUntilTheFirstIsBack) {
  const auto whole = ball_samples(0, 1, kBallWidth, kBallHeight);
  std::optional<Feeder> feeder(std::in_place, loopback(), V4L2_PIX_FMT_GREY, kBallWidth,
                               kBallHeight, Feeder::Pictures{whole});
  CameraRun run({loopback(), "grey", true});
  ASSERT_TRUE(run.start(kRequest));
  ASSERT_TRUE(run.next_frame());
  feeder->pause();
  EXPECT_TRUE(run.reports(Fault::Stalled));
  // The driver changes no format while its memory is mapped.
  run.release();
  feeder.reset();
  const Feeder::Pictures half{{whole.begin(), whole.begin() + kPixels / 4}};
  feeder.emplace(loopback(), V4L2_PIX_FMT_GREY, kBallWidth / 2, kBallHeight / 2, half);
  EXPECT_TRUE(run.reports(Fault::WrongFormat));
  feeder.reset();
  feeder.emplace(loopback(), V4L2_PIX_FMT_GREY, kBallWidth, kBallHeight, Feeder::Pictures{whole});
  EXPECT_TRUE(run.reports(Fault::None));
}

}  // namespace
}  // namespace orbwatch::hal
