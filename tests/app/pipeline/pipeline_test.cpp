// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <array>
#include <condition_variable>
#include <mutex>
#include <numeric>

#include "app/pictures/colour_maps.h"
#include "proc/optics/rotation.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"

namespace orbwatch::app::pipeline {
namespace {

double mean_of(const View& view) {
  const auto samples = view.picture.samples<std::uint8_t>();
  const std::size_t count = std::size_t{3} * samples.width * samples.height;
  return std::accumulate(samples.data, samples.data + count, 0.0) / static_cast<double>(count);
}

constexpr KeptViews kKept{2, 1};

/// Records views and status; the test waits for the status that it expects.
class RecordingSink : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  PictureNeeds needs(std::size_t view, hal::TimePoint) override {
    const std::lock_guard lock(mutex_);
    return needs_[view];
  }
  KeptViews keeps() const override { return kKept; }
  void accept(const ViewPtr& view) override {
    const std::lock_guard lock(mutex_);
    if (hold_) held_.push_back(view);
    const bool has_picture = view->picture.planes[0].data != nullptr;
    brightness_[view->index] = has_picture ? mean_of(*view) : 0;
    formats_[view->index] = has_picture ? std::optional(view->picture.format) : std::nullopt;
    views_.push_back(std::string(view->name));
    if (view->index == 0) shown_set_ = view->frame_set;
    changed_.notify_all();
  }
  void accept(const Status& status) override {
    const std::lock_guard lock(mutex_);
    if (status.frame_set == 1 && status_.frame_set == 0) views_before_status_ = views_.size();
    status_ = status;
    changed_.notify_all();
  }
  void hold_views() {
    const std::lock_guard lock(mutex_);
    hold_ = true;
  }
  template <class Condition>
  Status wait_for(Condition condition) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return condition(status_); }));
    return status_;
  }
  /// Waits for the display view of a set, which comes last.
  void wait_for_pictures(std::uint64_t set) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return shown_set_ == set; }));
  }
  void need(std::size_t view, const PictureNeeds& needs) {
    const std::lock_guard lock(mutex_);
    needs_[view] = needs;
  }
  /// Format of a view's newest picture.
  std::optional<PixelFormat> format(std::size_t view) {
    const std::lock_guard lock(mutex_);
    return formats_[view];
  }
  /// Mean sample of a view's newest picture.
  double brightness(std::size_t view) {
    const std::lock_guard lock(mutex_);
    return brightness_[view];
  }
  std::vector<std::string> views() {
    const std::lock_guard lock(mutex_);
    return views_;
  }
  /// Number of views that came before the first set's status.
  std::size_t views_before_status() {
    const std::lock_guard lock(mutex_);
    return views_before_status_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Status status_;
  std::vector<std::string> views_;
  std::size_t views_before_status_ = 0;
  std::uint64_t shown_set_ = 0;
  std::vector<ViewPtr> held_;
  bool hold_ = false;
  std::array<PictureNeeds, 2> needs_{need_of(PixelFormat::Rgb), need_of(PixelFormat::Rgb)};
  std::array<std::optional<PixelFormat>, 2> formats_;
  std::array<double, 2> brightness_{};
};

class PipelineTest : public testing::Test {
 protected:
  PipelineTest() {
    add_camera("thermal", PixelFormat::Y16);
    add_camera("grey", PixelFormat::Grey);
    plan.workers = 1;
    plan.deadline = std::chrono::seconds(20);
    plan.sync.window = plan.sync.max_wait = std::chrono::milliseconds(1);
    plan.views.push_back(view("seen", 0, {1}));
    plan.recipes.push_back(compiled(recipe_plan(view("measured", 1, {0, 1}), 30000, 0.04)));
    plan.view_count = 2;
  }

  void add_camera(const std::string& name, PixelFormat format) {
    auto camera = std::make_unique<HandCamera>(name, format);
    plan.formats.push_back(camera->configure({}).value());
    cameras.push_back(camera.get());
    plan.cameras.push_back(std::move(camera));
  }
  ViewPlan view(const std::string& name, std::size_t index,
                const std::vector<std::size_t>& sources) const {
    const auto projection =
        optics::ViewProjection::make({optics::ViewKind::Perspective, {}, 120, {}, 96, 64}).value();
    ViewPlan view{index,       name, projection, {}, Combine::Mix, remap::Interpolation::Bilinear,
                  std::nullopt};
    for (const std::size_t n : sources) {
      const auto ball = optics::BallProjection::make(
                            optics::BallModel::make(optics::BallModel::Kind::Exact, 350).value(),
                            {{49.5, 49.5}, 48, 48, 0}, {})
                            .value();
      const double high = plan.formats[n].format == PixelFormat::Y16 ? 65535 : 255;
      view.sources.push_back({n, plan.formats[n], ball, 1, {colour_map_table("hot"), 0, high}});
    }
    return view;
  }
  void start() {
    pipeline.emplace(std::move(plan));
    ASSERT_TRUE(pipeline->start({&sink}));
  }
  void expose_both(std::uint16_t bright) {
    const auto moment = hal::Clock::now();
    cameras[1]->expose(200, moment);
    cameras[0]->expose(bright, moment);
  }

  PipelinePlan plan;
  std::vector<HandCamera*> cameras;
  RecordingSink sink;
  std::optional<Pipeline> pipeline;
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

TEST_F(PipelineTest, ATriggeredCameraGivesOneFrameForEachTriggerAndTheRestIsMissed) {
  const auto trigger = std::make_shared<hal::FrameTrigger>(
      hal::TriggerSettings{.mode = hal::TriggerMode::Line}, nullptr);
  plan.triggers = {trigger, nullptr};
  start();
  constexpr std::uint64_t kTriggers = 12;
  std::uint64_t frames = 0;
  for (std::uint64_t i = 1; i <= kTriggers; ++i) {
    trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
    if (i % 3 == 1) continue;  // the next edge comes before the camera exposes
    cameras[0]->expose(40000);
    cameras[0]->expose(40000);  // without a trigger: in no set
    ++frames;
    sink.wait_for([&](const Status& s) { return s.frame_set == frames; });
  }
  const Status status =
      sink.wait_for([&](const Status& s) { return s.cameras[0].triggers == kTriggers; });
  EXPECT_EQ(status.trigger, kTriggers);
  EXPECT_EQ(status.cameras[0].frames, frames);
  EXPECT_EQ(status.cameras[0].missed, kTriggers - frames);
  EXPECT_EQ(status.cameras[0].lost, 0U) << "frames without a trigger are not lost";
}

TEST_F(PipelineTest, AFrameStampedAtItsEndBelongsToTheTriggerThatBeganIt) {
  const auto trigger = std::make_shared<hal::FrameTrigger>(
      hal::TriggerSettings{.mode = hal::TriggerMode::Line}, nullptr);
  plan.triggers = {trigger, nullptr};
  constexpr std::chrono::milliseconds kPeriod{10}, kExposure{6}, kReadout{8};
  cameras[0]->set_stamps({.readout_time = kReadout});
  start();
  const auto begin = hal::Clock::now();
  trigger->on_edge({hal::Edge::Rising, begin});
  for (std::uint64_t part = 1; part <= 5; ++part) {
    // The next part's edge comes before this one's frame has arrived.
    const auto edge = begin + (part - 1) * kPeriod;
    trigger->on_edge({hal::Edge::Rising, edge + kPeriod});
    cameras[0]->expose(40000, {.exposure_start = edge + kExposure + kReadout,
                               .stamp_source = hal::StampSource::FrameEnd,
                               .exposure_time = kExposure});
    const Status status = sink.wait_for([part](const Status& s) { return s.frame_set == part; });
    EXPECT_EQ(status.trigger, part);
    EXPECT_EQ(status.cameras[0].missed, 0U);
  }
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

TEST_F(PipelineTest, ACameraFaultMissesItsTriggers) {
  const auto trigger = std::make_shared<hal::FrameTrigger>(
      hal::TriggerSettings{.mode = hal::TriggerMode::Line}, nullptr);
  plan.triggers = {trigger, nullptr};
  start();
  trigger->on_edge({hal::Edge::Rising, hal::Clock::now()});
  cameras[0]->fail_with(hal::Fault::Unplugged);
  const Status status = sink.wait_for([](const Status& s) { return s.cameras[0].missed == 1; });
  EXPECT_EQ(status.cameras[0].triggers, 1U);
  EXPECT_EQ(status.cameras[0].frames, 0U);
}

TEST_F(PipelineTest, ADamagedFrameMissesItsTriggerAndIsNoFault) {
  const auto trigger = std::make_shared<hal::FrameTrigger>(
      hal::TriggerSettings{.mode = hal::TriggerMode::Line}, nullptr);
  plan.triggers = {trigger, nullptr};
  start();
  const auto first = hal::Clock::now();
  const auto second = first + std::chrono::milliseconds(1);
  trigger->on_edge({hal::Edge::Rising, first});
  trigger->on_edge({hal::Edge::Rising, second});
  cameras[0]->expose_damaged(first);
  cameras[0]->expose(40000, second);
  const Status status = sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  EXPECT_EQ(status.trigger, 2U) << "still waited for its frame";
  EXPECT_EQ(status.cameras[0].fault, hal::Fault::None);
  EXPECT_EQ(status.cameras[0].damaged, 1U);
  EXPECT_EQ(status.cameras[0].missed, 1U);
  EXPECT_EQ(status.cameras[0].frames, 1U);
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

TEST_F(PipelineTest, ACameraOfAnotherFormatThanExpectedIsSeenOnceItsViewsAreCompiled) {
  const auto formats = plan.formats;
  const auto compile = [&] {
    return compiled(recipe_plan(view("measured", 1, {0, 1}), 30000, 0.04));
  };
  auto real = compile();
  const auto seen = view("seen", 0, {1});
  // The files do not state its format, so 8 bits are expected; it delivers 16.
  plan.formats[0].format = PixelFormat::Grey;
  plan.recipes[0] = compiled(recipe_plan(view("measured", 1, {0, 1}), 100, 0));
  plan.absent[0] = true;
  plan.colour_maps = {colour_map_table("grey")};
  start();
  ASSERT_EQ(pipeline->set_colour_range(1, 0, {0, 10}), CommandResult::Done);
  cameras[1]->expose(200);
  sink.wait_for([](const Status& s) { return s.frame_set == 1; });
  Recompiled recompiled;
  recompiled.formats = formats;
  recompiled.sources[0] = seen.sources;
  recompiled.recipes.push_back(std::move(real));
  ASSERT_TRUE(pipeline->take_over(std::move(recompiled)));
  EXPECT_EQ(pipeline->formats()[0].format, PixelFormat::Y16);
  ASSERT_TRUE(pipeline->admit(0, formats[0]));
  cameras[0]->expose(40000);  // it paces from now on
  expose_both(40000);
  const Status status =
      sink.wait_for([](const Status& s) { return s.regions[0].quality != Quality::NotMeasured; });
  EXPECT_EQ(status.state, SystemState::Running);
  EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, 40000 * 0.04 - 273.15, 0.1);
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
