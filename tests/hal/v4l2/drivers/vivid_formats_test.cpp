// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/drivers/picture_colours.h"
#include "tests/hal/v4l2/drivers/vivid_device.h"

/// Every format that both vivid and orbwatch support, through the camera, checked against the
/// colour bars that vivid paints.
namespace orbwatch::hal {
namespace {

constexpr int kBars = 8;
constexpr int kBarWidth = kVividRequest.width / kBars;

/// Controls that make vivid paint only bars of full colours.
const CameraRun::Controls kPlainBars{{"test_pattern", 1}, {"osd_text_mode", 2}};

/// Colours: white, yellow, cyan, green, magenta, red, blue, black.
std::array<double, 3> bar_colour(int bar) {
  constexpr std::array kBits{7, 6, 3, 2, 5, 4, 1, 0};  // red 4, green 2, blue 1
  const int bits = kBits[static_cast<std::size_t>(bar)];
  return {bits & 4 ? 255.0 : 0, bits & 2 ? 255.0 : 0, bits & 1 ? 255.0 : 0};
}

double luminance(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

std::vector<PixelCoding> codings_of_vivid() {
  std::vector<PixelCoding> codings;
  const auto device = find_v4l2_device(kVivid).and_then(V4l2Device::open);
  if (!device) return codings;  // EveryInterfaceHasItsFormats fails then
  for (const std::uint32_t fourcc : device->formats()) {
    if (const PixelCoding* coding = find_coding(fourcc)) codings.push_back(*coding);
  }
  return codings;
}

std::vector<PixelCoding> mosaics_of_vivid() {
  auto codings = codings_of_vivid();
  std::erase_if(codings, [](const PixelCoding& coding) { return coding.mosaic == Mosaic::None; });
  return codings;
}

std::string name_of(const testing::TestParamInfo<PixelCoding>& info) {
  return std::string(info.param.name);
}

TEST(VividFormats, EveryInterfaceHasItsFormats) {
  std::vector<std::string> names;
  for (const PixelCoding& coding : codings_of_vivid()) names.emplace_back(coding.name);
  std::vector<std::string> expected{
      "yuyv",   "uyvy",   "nv12",   "nv21",   "yuv420", "rgb24",  "bgr24",  "grey",
      "y10",    "y12",    "y16",    "y16_be", "xbgr32", "bgr32",  "abgr32", "rggb8",
      "grbg8",  "gbrg8",  "bggr8",  "rggb10", "grbg10", "gbrg10", "bggr10", "rggb12",
      "grbg12", "gbrg12", "bggr12", "rggb16", "grbg16", "gbrg16", "bggr16"};
  // The scenario loads vivid with either interface and sets this variable.
  if (std::getenv("ORBWATCH_VIVID_MULTI_PLANAR") != nullptr) {
    expected.insert(expected.end(), {"nv12m", "nv21m", "yuv420m"});
  }
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(expected));
}

class VividFormat : public testing::TestWithParam<PixelCoding> {};

TEST_P(VividFormat, ShowsTheColoursOfTheBars) {
  CameraRun run({kVivid, std::string(GetParam().name), true}, kPlainBars);
  ASSERT_TRUE(run.start(kVividRequest));
  EXPECT_EQ(run.format().width, kVividRequest.width);
  EXPECT_EQ(run.format().height, kVividRequest.height);
  for (int n = 0; n < 3; ++n) {
    const Frame frame = run.next_frame();
    ASSERT_TRUE(frame);
    const Picture& picture = frame->picture;
    ASSERT_EQ(picture.format, frame_format(GetParam(), true));
    ASSERT_EQ(picture.width, kVividRequest.width);
    ASSERT_EQ(picture.height, kVividRequest.height);
    const bool grey = info(picture.format).colour == ColourModel::Luminance;
    for (int bar = 0; bar < kBars; ++bar) {
      for (const int y : {1, 90, 177}) {
        const int x = bar * kBarWidth + kBarWidth / 2 + y % 2;
        const auto colour = colours_at(picture, x, y);
        const auto truth = bar_colour(bar);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(colour[c], grey ? luminance(truth) : truth[c], 4)
              << "bar " << bar << ", row " << y << ", colour " << c;
        }
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(OfDriver, VividFormat, testing::ValuesIn(codings_of_vivid()), name_of);

class VividMosaic : public testing::TestWithParam<PixelCoding> {};

TEST_P(VividMosaic, StaysAsTheSensorSeesIt) {
  CameraRun run({kVivid, std::string(GetParam().name), false}, kPlainBars);
  ASSERT_TRUE(run.start(kVividRequest));
  const Frame frame = run.next_frame();
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->picture.format, GetParam().format);
  // Colours of the pixels (0,0), (1,0), (0,1), (1,1): red 0, green 1, blue 2.
  const std::string order = std::string(GetParam().name).substr(0, 4);
  for (int bar = 0; bar < kBars; ++bar) {
    for (int i = 0; i < 4; ++i) {
      const std::size_t colour = std::string_view("rgb").find(order[static_cast<std::size_t>(i)]);
      const int x = bar * kBarWidth + kBarWidth / 2 + i % 2;
      EXPECT_NEAR(colours_at(frame->picture, x, 90 + i / 2)[0], bar_colour(bar)[colour], 4)
          << "bar " << bar << ", pixel " << i;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(OfDriver, VividMosaic, testing::ValuesIn(mosaics_of_vivid()), name_of);

TEST(VividFormats, ASizeThatIsNotOnOfferIsRefusedWithTheListOfThose) {
  V4l2Camera camera(vivid_settings());
  const auto format = camera.configure({.width = 321, .height = 180});
  ASSERT_FALSE(format);
  EXPECT_THAT(format.error().message,
              testing::AllOf(testing::HasSubstr("yuyv 321x180"), testing::HasSubstr("320x180")));
  const auto unknown = V4l2Camera({kVivid, "mjpeg", true}).configure({});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, testing::HasSubstr("YUYV"));
}

TEST(VividFormats, BuffersAreExported) {
  V4l2Device device = open_vivid();
  const auto negotiated = negotiate_format(device, {"yuyv", true, kVividRequest});
  ASSERT_TRUE(negotiated) << negotiated.error().detail;
  auto stream = V4l2Stream::start(std::move(device), *negotiated, kFreeRunningBuffers, {});
  ASSERT_TRUE(stream) << stream.error().detail;
  const TimePoint deadline = Clock::now() + std::chrono::seconds(60);
  DeviceResult<std::optional<V4l2Stream::Captured>> captured;
  do {
    captured = (*stream)->next(deadline);
    ASSERT_TRUE(captured) << captured.error().detail;
  } while (!*captured && Clock::now() < deadline);
  ASSERT_TRUE(*captured);
  ASSERT_EQ((*captured)->frame->memory_planes.size(), 1U);
  EXPECT_TRUE((*captured)->frame->memory_planes[0].dma_buffer);
}

}  // namespace
}  // namespace orbwatch::hal
