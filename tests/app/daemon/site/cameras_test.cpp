// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <utility>

namespace orbwatch::app::daemon {
namespace {

/// Camera that shows the request it received.
class RequestedCamera : public hal::Camera {
 public:
  RequestedCamera() : Camera({"requested", "requested", "test"}) {}

  hal::StreamRequest requested;

 private:
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest& request) override {
    requested = request;
    return hal::StreamFormat{PixelFormat::Grey, {}, 8, 8, 10};
  }
  void run(const std::stop_token&) override {}
};

std::size_t requested_buffers(hal::TriggerMode mode) {
  files::Resolved site;
  site.site.cameras.emplace_back().trigger.mode = mode;
  optics::RigCamera& rig = site.rig.cameras.emplace_back();
  rig.width = rig.height = 8;
  site.rig_cameras = {0};
  RequestedCamera camera;
  const auto format = open_camera(camera, site, 0);
  EXPECT_TRUE(format) << format.error().detail;
  return camera.requested.buffers;
}

TEST(OpenCamera, ATriggeredCameraHasBuffersForAFullQueue) {
  EXPECT_EQ(requested_buffers(hal::TriggerMode::Line), hal::kTriggeredBuffers);
  EXPECT_EQ(requested_buffers(hal::TriggerMode::Off), hal::kFreeRunningBuffers);
}

TEST(AddCameras, ATriggerWaitsForTheNextFrameOfASlowCamera) {
  files::Resolved site;
  files::CameraSettings& settings = site.site.cameras.emplace_back();
  settings.trigger.mode = hal::TriggerMode::Line;
  settings.trigger_source = kSoftwareSource;
  OpenedCameras opened;
  opened.cameras.push_back(std::make_unique<RequestedCamera>());
  opened.formats.emplace_back().frame_rate = 0.25;
  Lines lines({});
  pipeline::PipelinePlan plan;
  add_cameras(plan, std::move(opened), site, lines);
  const hal::TimePoint edge = hal::Clock::now();
  plan.triggers.at(0)->fire(edge);
  EXPECT_TRUE(plan.triggers[0]->claim(edge + std::chrono::seconds(4)));
  plan.triggers[0]->fire(edge);
  EXPECT_FALSE(plan.triggers[0]->claim(edge + std::chrono::minutes(1)));
}

/// A thermal camera.
class ThermalCamera : public hal::Camera {
 public:
  explicit ThermalCamera(std::optional<hal::CountScale> says)
      : Camera({"thermal", "thermal", "test"}), says_(std::move(says)) {}

  std::optional<hal::CountScale> count_scale() const override { return says_; }

 private:
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest&) override {
    return hal::StreamFormat{PixelFormat::Y16, {}, 8, 8, 10};
  }
  void run(const std::stop_token&) override {}

  std::optional<hal::CountScale> says_;
};

hal::DeviceResult<hal::StreamFormat> opened(const signals::RadiometrySettings& radiometry,
                                            std::optional<hal::CountScale> says) {
  files::Resolved site;
  site.site.cameras.emplace_back().radiometry = radiometry;
  optics::RigCamera& rig = site.rig.cameras.emplace_back();
  rig.width = rig.height = 8;
  site.rig_cameras = {0};
  ThermalCamera camera(std::move(says));
  return open_camera(camera, site, 0);
}

hal::DeviceResult<double> scale_of(const signals::RadiometrySettings& radiometry,
                                   std::optional<hal::CountScale> says) {
  return opened(radiometry, std::move(says)).map([](const hal::StreamFormat& format) {
    return format.kelvin_per_count;
  });
}

TEST(OpenCamera, TheScaleOfCountsIsTheStatedOneOrTheCameras) {
  const hal::CountScale linear{0.1, "IRFormat is TemperatureLinear100mK"};
  EXPECT_EQ(scale_of({.kelvin_per_count = 0.04}, {}), 0.04);
  EXPECT_EQ(scale_of({.kelvin_per_count = 0.1}, linear), 0.1);
  EXPECT_EQ(scale_of({.states_scale = true}, linear), 0.1);
  EXPECT_EQ(scale_of({}, linear), 0) << "percent of full scale, as long as the site says so";
}

TEST(OpenCamera, CountsMayBeginAtAnyTemperature) {
  const auto format = opened({.kelvin_per_count = 0.1, .kelvin_offset = 273.15}, {});
  ASSERT_TRUE(format) << format.error().detail;
  EXPECT_EQ(format->kelvin_per_count, 0.1);
  EXPECT_EQ(format->kelvin_offset, 273.15);
}

/// Request for a stream without a stated size from a camera with this back-end.
hal::StreamRequest requested_of(files::BackEndSettings back_end) {
  files::Resolved site;
  site.site.cameras.emplace_back().back_end = std::move(back_end);
  optics::RigCamera& rig = site.rig.cameras.emplace_back();
  rig.width = rig.height = 8;
  site.rig_cameras = {0};
  RequestedCamera camera;
  EXPECT_TRUE(open_camera(camera, site, 0));
  return camera.requested;
}

TEST(OpenCamera, ARadiometricV4l2CameraOfAnotherFormatIsToldHowToBeConfigured) {
  files::Resolved site;
  files::CameraSettings& settings = site.site.cameras.emplace_back();
  settings.radiometry.kelvin_per_count = 0.04;
  settings.back_end = hal::V4l2Settings{};
  optics::RigCamera& rig = site.rig.cameras.emplace_back();
  rig.width = rig.height = 8;
  site.rig_cameras = {0};
  RequestedCamera camera;
  const auto format = open_camera(camera, site, 0);
  ASSERT_FALSE(format);
  EXPECT_EQ(format.error().fault, hal::Fault::WrongFormat);
  EXPECT_THAT(format.error().detail, testing::HasSubstr("state pixel_format = \"y16\""));
}

TEST(OpenCamera, AV4l2CameraIsAskedForTheRigsSize) {
  const hal::StreamRequest v4l2 = requested_of(hal::V4l2Settings{});
  EXPECT_EQ(v4l2.width, 8);
  EXPECT_EQ(v4l2.height, 8);
  EXPECT_EQ(requested_of(hal::ReplaySettings{}).width, 0);
}

TEST(OpenCamera, AScaleThatContradictsTheCameraIsRefused) {
  const auto refusal = [](const signals::RadiometrySettings& radiometry,
                          std::optional<hal::CountScale> says) {
    const auto scale = scale_of(radiometry, std::move(says));
    EXPECT_FALSE(scale);
    if (scale) return std::string();
    EXPECT_EQ(scale.error().fault, hal::Fault::WrongFormat);
    return scale.error().detail;
  };
  EXPECT_EQ(refusal({.kelvin_per_count = 0.04},
                    hal::CountScale{0.1, "IRFormat is TemperatureLinear100mK"}),
            "has kelvin_per_count 0.04, but says 0.1: IRFormat is TemperatureLinear100mK");
  for (const signals::RadiometrySettings& radiometry :
       {signals::RadiometrySettings{.kelvin_per_count = 0.04},
        signals::RadiometrySettings{.states_scale = true}}) {
    EXPECT_THAT(refusal(radiometry, hal::CountScale{0, "IRFormat is Radiometric"}),
                testing::HasSubstr("not temperatures: IRFormat is Radiometric; set it with"));
  }
  EXPECT_THAT(refusal({.states_scale = true}, {}), testing::HasSubstr("state kelvin_per_count"));
  EXPECT_EQ(refusal({.kelvin_per_count = 0.1, .kelvin_offset = 5},
                    hal::CountScale{0.1, "IRFormat is TemperatureLinear100mK"}),
            "has kelvin_offset 5, but says counts that begin at 0 K: IRFormat is "
            "TemperatureLinear100mK");
}

}  // namespace
}  // namespace orbwatch::app::daemon
