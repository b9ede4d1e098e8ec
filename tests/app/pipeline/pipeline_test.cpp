// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "proc/optics/rotation.h"
#include "tests/app/pipeline/pipeline_case.h"

namespace orbwatch::app::pipeline {
namespace {

/// Camera with a control that is the scale of its counts.
class ScaledCamera : public HandCamera {
 public:
  ScaledCamera() : HandCamera("scaled", PixelFormat::Y16) {}

  std::optional<hal::CountScale> count_scale() const override {
    return hal::CountScale{scale_, "its control"};
  }

 private:
  Result<> do_set(std::string_view control, double value) override {
    if (control != "Scale") return Camera::do_set(control, value);
    scale_ = value;
    return {};
  }

  std::atomic<double> scale_ = 0.04;
};

TEST_F(PipelineTest, MakesViewsAndMeasuresThem) {
  start();
  expose_both(40000);
  const Status status = sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  EXPECT_EQ(status.state, SystemState::Running);
  EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, 40000 * 0.04 - 273.15, 0.1);
  EXPECT_GT(status.regions[0].signals.hot_spot_yaw, 20) << "left in the ball's picture is +X";
  EXPECT_GT(status.regions[0].signals.hot_spot_solid_angle, 0);
  EXPECT_EQ(status.cameras[0].frames, 1U);
  const Status next = sink.wait_for([](const Status& s) { return s.views[0].published == 1; });
  EXPECT_EQ(next.frame_set, 1U);
  EXPECT_EQ(next.views[1].published, 1U);
  EXPECT_EQ(sink.views(), (std::vector<std::string>{"measured", "seen"}));
  EXPECT_EQ(sink.views_before_status(), 0U) << "the PLC does not wait for pictures";
}

TEST_F(PipelineTest, AViewIsMadeInTheFormatThatItsReadersNeedAndMeasuredWithoutAny) {
  start();
  std::uint64_t set = 0;
  const PictureNeeds jpeg{false, false, false, true};
  const std::vector<std::pair<PictureNeeds, std::optional<PixelFormat>>> cases{
      {need_of(PixelFormat::Rgb), PixelFormat::Rgb},
      {{}, std::nullopt},
      {need_of(PixelFormat::Grey), PixelFormat::Grey},
      {jpeg, PixelFormat::I420}};
  for (const auto& [needs, format] : cases) {
    sink.need(0, needs);
    sink.need(1, needs);
    expose_both(40000);
    ++set;
    const Status status = sink.wait_for([&](const Status& s) { return s.frame_set == set; });
    sink.wait_for_pictures(set);
    EXPECT_EQ(sink.format(0), format);
    EXPECT_EQ(sink.format(1), format);
    EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, 40000 * 0.04 - 273.15, 0.1);
  }
}

TEST_F(PipelineTest, ColourCamerasThatAreExposedApartAreBroughtTogether) {
  plan = {};
  plan.deadline = std::chrono::seconds(20);  // else a busy machine leaves out pictures
  cameras.clear();
  add_camera("first", PixelFormat::Rgb);
  add_camera("second", PixelFormat::Rgb);
  plan.sync.window = plan.sync.max_wait = std::chrono::milliseconds(1);
  plan.views.push_back(view("both", 0, {0, 1}));
  plan.view_count = 1;
  start();
  cameras[1]->set_gain(0.4);
  std::uint64_t set = 0;
  const auto next_brightness = [&] {
    expose_both(200);
    ++set;
    sink.wait_for_pictures(set);
    return sink.brightness(0);
  };
  const double apart = next_brightness();
  double together = apart;
  const auto end = hal::Clock::now() + std::chrono::seconds(30);
  while (together < 1.2 * apart && hal::Clock::now() < end) together = next_brightness();
  // The mean of 1 and 0.4 becomes 1.
  EXPECT_NEAR(together / apart, 1 / 0.7, 0.1);
}

TEST_F(PipelineTest, TheHeartbeatGoesOnWithoutFrames) {
  start();
  const Status status = sink.wait_for([](const Status& s) { return s.heartbeat >= 3; });
  EXPECT_EQ(status.state, SystemState::Starting);
  EXPECT_FALSE(signals::is_valid(status.regions[0].signals.hot_spot_solid_angle));
}

TEST_F(PipelineTest, AMissingCameraIsAStateAndTheOtherGoesOn) {
  start();
  expose_both(40000);
  sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  cameras[0]->fail_with(hal::Fault::Unplugged);
  cameras[1]->expose(200);
  Status status = sink.wait_for([](const Status& s) { return s.frame_set == 2; });
  EXPECT_EQ(status.state, SystemState::Degraded);
  EXPECT_EQ(status.cameras[0].fault, hal::Fault::Unplugged);
  EXPECT_FALSE(signals::is_valid(status.regions[0].signals.hot_spot_solid_angle))
      << "the measured camera is away";
  EXPECT_TRUE(status.views[0].live) << "of the camera that delivers";
  cameras[1]->fail_with(hal::Fault::Stalled);
  status = sink.wait_for([](const Status& s) { return s.state == SystemState::Fault; });
  EXPECT_FALSE(status.views[0].live);
  expose_both(40000);
  status = sink.wait_for([](const Status& s) {
    return s.state == SystemState::Running && signals::is_valid(s.regions[0].signals.hot_spot_yaw);
  });
  EXPECT_EQ(status.cameras[0].fault, hal::Fault::None);
}

TEST_F(PipelineTest, AFrameOfAnotherSizeIsAFaultNotACrash) {
  start();
  cameras[0]->deliver_wrong_size();
  const Status status =
      sink.wait_for([](const Status& s) { return s.cameras[0].fault == hal::Fault::WrongFormat; });
  EXPECT_EQ(status.frame_set, 0U);
  expose_both(40000);
  sink.wait_for(
      [](const Status& s) { return s.cameras[0].fault == hal::Fault::None && s.frame_set > 0; });
}

/// Both views have one size: one is rendered, two of each are kept, and one more.
TEST_F(PipelineTest, ASinkThatHoldsMoreThanItSaidLosesViewsButNotTheMeasurement) {
  sink.hold_views();
  start();
  for (std::uint64_t n = 1; n <= 10; ++n) {
    expose_both(static_cast<std::uint16_t>(40000 + n));
    const Status status = sink.wait_for([n](const Status& s) { return s.frame_set == n; });
    EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, (40000.0 + n) * 0.04 - 273.15,
                0.021);
  }
  const Status status = sink.wait_for(
      [](const Status& s) { return s.views[0].published + s.views[0].skipped == 10; });
  EXPECT_EQ(status.views[0].published, 3U);
  EXPECT_EQ(status.views[1].published, 3U);
  EXPECT_EQ(status.views[0].skipped, 7U);
  EXPECT_EQ(status.views[1].skipped, 7U);
}

TEST_F(PipelineTest, OverrunsAreCountedAndSlowDisplayViewsOnly) {
  plan.deadline = std::chrono::nanoseconds(1);
  start();
  for (std::uint64_t n = 1; n <= 16; ++n) {
    expose_both(40000);
    sink.wait_for([n](const Status& s) { return s.frame_set == n; });
  }
  const Status status = sink.wait_for([](const Status& s) { return s.overruns == 16; });
  EXPECT_EQ(status.views[1].published, 16U) << "what is measured is never slowed down";
  EXPECT_EQ(status.views[0].published, 4U) << "1, then 2, then 8 and 16";
  EXPECT_EQ(status.views[0].published + status.views[0].skipped, 16U);
}

TEST_F(PipelineTest, ACameraWithoutAStatedRateHasThatOfItsFrames) {
  plan.deadline = {};
  for (hal::StreamFormat& format : plan.formats) format.frame_rate = 0;
  start();
  // The sets follow each other so closely that processing takes most of the period.
  const auto end = hal::Clock::now() + std::chrono::seconds(60);
  Status status;
  for (std::uint64_t n = 1; status.load < 0.2 && hal::Clock::now() < end; ++n) {
    expose_both(40000);
    status = sink.wait_for([n](const Status& s) { return s.frame_set == n; });
  }
  EXPECT_GE(status.load, 0.2) << "of a second it would be a hundredth";
}

TEST_F(PipelineTest, ACameraWithoutStampsIsAFaultWhereItIsJoinedWithAnother) {
  start();
  cameras[1]->expose(200);
  for (int n = 0; n < 10; ++n) {
    cameras[0]->expose(
        40000, {.exposure_start = hal::Clock::now(), .stamp_source = hal::StampSource::Arrival});
  }
  const Status status =
      sink.wait_for([](const Status& s) { return s.cameras[0].fault == hal::Fault::NoTimeStamps; });
  EXPECT_EQ(status.cameras[0].frames, 0U);
  EXPECT_EQ(status.cameras[1].fault, hal::Fault::None);
}

TEST_F(PipelineTest, ReportsWhichProcessInputsAreActive) {
  const auto door = std::make_shared<hal::ProcessInput>(true);
  const auto laser = std::make_shared<hal::ProcessInput>(false);
  plan.process_inputs = {door, laser};
  start();
  sink.wait_for([](const Status& s) { return s.process_inputs == 0b01; });
  laser->set(true);
  sink.wait_for([](const Status& s) { return s.process_inputs == 0b11; });
  door->set(false);
  sink.wait_for([](const Status& s) { return s.process_inputs == 0b10; });
  const Status both = sink.wait_for([](const Status&) { return true; });
  EXPECT_EQ(both.process_inputs_known, 0b11U);
  EXPECT_EQ(both.process_input_edges[0], 0U);
  EXPECT_EQ(both.process_input_edges[1], 1U);
  laser->set({});
  sink.wait_for(
      [](const Status& s) { return s.process_inputs == 0 && s.process_inputs_known == 0b01; });
}

TEST_F(PipelineTest, ReportsWhatItsSurroundingsSay) {
  plan.surroundings = [](hal::TimePoint) {
    Surroundings surroundings;
    surroundings.health.board_temperature = 51;
    surroundings.line_faults = 0b101;
    surroundings.interface_faults = 0b10;
    return surroundings;
  };
  start();
  const Status status = sink.wait_for([](const Status& s) { return s.heartbeat > 0; });
  EXPECT_EQ(status.health.board_temperature, 51);
  EXPECT_EQ(status.line_faults, 0b101U);
  EXPECT_EQ(status.interface_faults, 0b10U);
}

TEST_F(PipelineTest, AnAbsentCameraIsAFaultAndTakenUpWhenItComes) {
  plan.absent[0] = true;
  start();
  cameras[1]->expose(200);
  Status status = sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  EXPECT_EQ(status.state, SystemState::Degraded);
  EXPECT_EQ(status.cameras[0].fault, hal::Fault::Unplugged);
  EXPECT_EQ(status.regions[0].quality, Quality::NotMeasured);
  pipeline->miss(0, hal::Fault::WrongFormat);
  sink.wait_for([](const Status& s) { return s.cameras[0].fault == hal::Fault::WrongFormat; });
  ASSERT_TRUE(pipeline->admit(0, pipeline->formats()[0]));
  cameras[0]->expose(40000);  // it paces from now on
  expose_both(40000);
  status =
      sink.wait_for([](const Status& s) { return s.regions[0].quality != Quality::NotMeasured; });
  EXPECT_EQ(status.state, SystemState::Running);
}

TEST_F(PipelineTest, AnAbsentCameraWhoseCountsARecipeRescalesStaysAbsent) {
  auto scaled = std::make_unique<ScaledCamera>();
  plan.formats[0] = scaled->configure({}).value();
  plan.formats[0].kelvin_per_count = 0.04;
  plan.cameras[0] = std::move(scaled);
  plan.absent[0] = true;
  RecipePlan second = recipe_plan(view("second", 2, {0, 1}), 30000, 0.04, 2);
  second.controls.push_back({{"scaled", 0}, "Scale", 0.4});
  plan.recipes.push_back(compiled(std::move(second)));
  plan.view_count = 3;
  start();
  ASSERT_EQ(pipeline->select_recipe(2), CommandResult::Done);
  sink.wait_for([](const Status& s) { return s.recipe == 2; });
  const auto admitted = pipeline->admit(0, pipeline->formats()[0]);
  ASSERT_FALSE(admitted);
  EXPECT_EQ(admitted.error().message,
            "the recipe's controls change what a count means: its control");
}

TEST_F(PipelineTest, ACameraOfAnotherFormatThanExpectedIsSeenOnceItsViewsAreCompiled) {
  const auto formats = plan.formats;
  auto real = recipe_of_both(30000, 0.04);
  const auto seen = view("seen", 0, {1});
  // The files do not state its format, so 8 bits are expected; it delivers 16.
  plan.formats[0].format = PixelFormat::Grey;
  plan.recipes[0] = recipe_of_both(100, 0);
  plan.view_count = 3;
  plan.absent[0] = true;
  plan.colour_maps = {colour_map_table("grey")};
  start();
  ASSERT_EQ(pipeline->set_colour_range(1, 0, {0, 10}), CommandResult::Done);
  latch_alarm();
  Recompiled recompiled;
  recompiled.formats = formats;
  recompiled.sources[0] = seen.sources;
  recompiled.recipes.push_back(std::move(real));
  ASSERT_TRUE(pipeline->take_over(std::move(recompiled)));
  EXPECT_EQ(pipeline->formats()[0].format, PixelFormat::Y16);
  ASSERT_TRUE(sink.delivered(0)) << "before its first frame set";
  EXPECT_EQ(sink.delivered(0)->format, PixelFormat::Y16);
  ASSERT_TRUE(pipeline->admit(0, formats[0]));
  cameras[0]->expose(40000);  // it paces from now on
  expose_both(40000);
  const Status status =
      sink.wait_for([](const Status& s) { return s.regions[0].quality != Quality::NotMeasured; });
  EXPECT_EQ(status.cameras[0].fault, hal::Fault::None);
  EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, 40000 * 0.04 - 273.15, 0.1);
  EXPECT_EQ(status.alarms[0].alarm.state, signals::AlarmState::LatchedUnacknowledged)
      << "nobody has acknowledged it";
  EXPECT_EQ(sink.events(),
            (std::vector{signals::AlarmEventKind::Raised, signals::AlarmEventKind::Cleared}));
}

TEST_F(PipelineTest, SelectsAViewOnCommand) {
  start();
  EXPECT_EQ(pipeline->select_view(1), CommandResult::Done);
  sink.wait_for([](const Status& s) { return s.selected_view == 1; });
  EXPECT_EQ(pipeline->select_view(2), CommandResult::ArgumentOutOfRange);
}

TEST_F(PipelineTest, StopsTwiceAndWithoutAStart) {
  start();
  expose_both(40000);
  pipeline->stop();
  pipeline->stop();
}

}  // namespace
}  // namespace orbwatch::app::pipeline
