#include <gmock/gmock.h>

#include <algorithm>

#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/drivers/vivid_device.h"

/// What vivid tells of itself and of its frames.
namespace orbwatch::hal {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Pair;

constexpr StreamRequest kRequest{.width = 320, .height = 180, .frame_rate = 60};

const V4l2DeviceInfo* find_vivid(const std::vector<V4l2DeviceInfo>& devices) {
  const auto found = std::find_if(devices.begin(), devices.end(),
                                  [](const V4l2DeviceInfo& d) { return d.bus == kVivid; });
  return found == devices.end() ? nullptr : &*found;
}

TEST(VividList, HasDriverCardBusAndStablePath) {
  const auto devices = list_v4l2_devices();
  const V4l2DeviceInfo* const vivid = find_vivid(devices);
  ASSERT_TRUE(vivid);
  EXPECT_EQ(vivid->driver, "vivid");
  EXPECT_EQ(vivid->card, "vivid");
  EXPECT_EQ(vivid->problem, "");
  EXPECT_THAT(vivid->path, HasSubstr("/dev/video"));
  ASSERT_THAT(vivid->stable_paths, Contains(HasSubstr("/dev/v4l/by-path/")));
  const std::string link = std::filesystem::path(vivid->stable_paths[0]).filename();
  EXPECT_EQ(find_v4l2_device(link).value(), vivid->stable_paths[0]);
  EXPECT_TRUE(V4l2Device::open(vivid->stable_paths[0]));
}

TEST(VividList, HasFormatsWithSizesAndRates) {
  const auto devices = list_v4l2_devices();
  const V4l2DeviceInfo* const vivid = find_vivid(devices);
  ASSERT_TRUE(vivid);
  const auto yuyv =
      std::find_if(vivid->formats.begin(), vivid->formats.end(),
                   [](const V4l2FormatInfo& format) { return format.fourcc == "YUYV"; });
  ASSERT_NE(yuyv, vivid->formats.end());
  EXPECT_EQ(yuyv->pixel_format, "yuyv");
  ASSERT_FALSE(yuyv->sizes.empty());
  EXPECT_EQ(size_text(yuyv->sizes[0].size), "320x180");
  EXPECT_THAT(yuyv->sizes[0].frame_rates, Contains(60.0));
  const auto big_endian =
      std::find_if(vivid->formats.begin(), vivid->formats.end(),
                   [](const V4l2FormatInfo& format) { return format.fourcc == "Y16-BE"; });
  ASSERT_NE(big_endian, vivid->formats.end());
  EXPECT_EQ(big_endian->pixel_format, "y16_be");
}

TEST(VividList, HasControlsWithRangesAndMenus) {
  const V4l2DeviceInfo vivid = describe(open_vivid());
  const auto control = [&vivid](const char* name) {
    const auto found = std::find_if(vivid.controls.begin(), vivid.controls.end(),
                                    [name](const V4l2ControlInfo& c) { return c.name == name; });
    EXPECT_NE(found, vivid.controls.end()) << name;
    return found == vivid.controls.end() ? V4l2ControlInfo() : *found;
  };
  const V4l2ControlInfo brightness = control("brightness");
  EXPECT_EQ(brightness.minimum, 0);
  EXPECT_EQ(brightness.maximum, 255);
  EXPECT_EQ(brightness.default_value, 128);
  EXPECT_TRUE(brightness.menu.empty());
  EXPECT_THAT(control("test_pattern").menu, Contains(Pair(1, "100% Colorbar")));
  EXPECT_TRUE(control("read_only_integer_32_bits").read_only);
}

TEST(VividControls, AreSetByAnySpellingAndRefusedOutsideTheirRange) {
  V4l2Device device = open_vivid();
  EXPECT_TRUE(set_control(device, "OSD Text Mode", 0));
  EXPECT_TRUE(set_control(device, "OsdTextMode", 0));
  ASSERT_TRUE(set_control(device, "GainAuto", 1));
  const auto automatic = set_control(device, "Gain", 100);
  ASSERT_FALSE(automatic);
  EXPECT_THAT(automatic.error().message, HasSubstr("automatism"));
  ASSERT_TRUE(set_control(device, "GainAuto", 0));
  EXPECT_TRUE(set_control(device, "Gain", 100));
  const auto large = set_control(device, "Gain", 256);
  ASSERT_FALSE(large);
  EXPECT_THAT(large.error().message, HasSubstr("it takes 0 to 255"));
  EXPECT_FALSE(set_control(device, "read_only_integer_32_bits", 0));
  const auto unknown = set_control(device, "warp", 1);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("brightness"));
}

TEST(VividFrames, AreNumberedAndStampedAndSayWhatTheStampTells) {
  // Vivid's menu: 0 the end of the frame, 1 the start of its exposure. It says when the frame will
  // end before it has; such a stamp is not believed.
  for (const StampSource source : {StampSource::Arrival, StampSource::ExposureStart}) {
    const double menu = source == StampSource::ExposureStart ? 1 : 0;
    CameraRun run({kVivid, "grey", true}, {{"timestamp_source", menu}});
    ASSERT_TRUE(run.start(kRequest));
    Frame last;
    for (int n = 0; n < 5; ++n) {
      const Frame frame = run.next_frame();
      ASSERT_TRUE(frame);
      EXPECT_EQ(frame->metadata.stamp_source, source);
      EXPECT_LE(frame->metadata.exposure_start, Clock::now());
      if (last) {
        EXPECT_GT(frame->metadata.sequence, last->metadata.sequence);
        EXPECT_GT(frame->metadata.exposure_start, last->metadata.exposure_start);
      }
      last = frame;
    }
  }
}

}  // namespace
}  // namespace orbwatch::hal
