// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/pipeline.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"

namespace orbwatch::app::pipeline {

inline double mean_of(const View& view) {
  const auto samples = view.picture.samples<std::uint8_t>();
  const std::size_t count = std::size_t{3} * samples.width * samples.height;
  return std::accumulate(samples.data, samples.data + count, 0.0) / static_cast<double>(count);
}

inline constexpr KeptViews kKept{2, 1};

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
  void accept_format(std::size_t camera, const hal::StreamFormat& format) override {
    const std::lock_guard lock(mutex_);
    delivered_[camera] = format;
  }
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
  void accept_event(const AlarmNotice& notice) override {
    const std::lock_guard lock(mutex_);
    events_.push_back(notice.event.kind);
  }
  /// Kinds of all notices so far.
  std::vector<signals::AlarmEventKind> events() {
    const std::lock_guard lock(mutex_);
    return events_;
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
  /// Format that a camera delivers in place of the expected one; nullopt: the expected one.
  std::optional<hal::StreamFormat> delivered(std::size_t camera) {
    const std::lock_guard lock(mutex_);
    return delivered_[camera];
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
  static constexpr std::size_t kMost = 3;  ///< views of a test

  std::mutex mutex_;
  std::condition_variable changed_;
  Status status_;
  std::vector<std::string> views_;
  std::size_t views_before_status_ = 0;
  std::uint64_t shown_set_ = 0;
  std::vector<signals::AlarmEventKind> events_;
  std::vector<ViewPtr> held_;
  bool hold_ = false;
  std::array<PictureNeeds, kMost> needs_{need_of(PixelFormat::Rgb), need_of(PixelFormat::Rgb)};
  std::array<std::optional<PixelFormat>, kMost> formats_;
  std::array<double, kMost> brightness_{};
  std::array<std::optional<hal::StreamFormat>, kMost> delivered_;  ///< by camera
};

/// A pipeline with a thermal and a grey camera that the test exposes, a display view and a measured
/// one.
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
  /// Recipe with a region of the first camera, and one of the second whose hot spot latches an
  /// alarm.
  std::unique_ptr<CompiledRecipe> recipe_of_both(double threshold, double kelvin_per_count) const {
    RecipePlan both = recipe_plan(view("measured", 1, {0, 1}), threshold, kelvin_per_count);
    RecipePlan second = recipe_plan(view("second", 2, {1}), 225);
    both.views.push_back(std::move(second.views[0]));
    both.regions.push_back(std::move(second.regions[0]));
    both.regions[1].name = "second";
    both.regions[1].view = 1;
    signals::AlarmLimits limits;  // for hot_spot_present
    limits.region = 1;
    limits.high_alarm = 0.5;
    limits.loss_delay.reset();
    limits.latching = true;
    both.alarms.push_back(limits);
    return compiled(std::move(both));
  }
  /// Exposes a hot spot of the second camera, then none.
  void latch_alarm() {
    const auto expose_until = [this](std::uint16_t bright, signals::AlarmState state) {
      cameras[1]->expose(bright);
      sink.wait_for([state](const Status& s) { return s.alarms[0].alarm.state == state; });
    };
    expose_until(250, signals::AlarmState::Unacknowledged);
    expose_until(200, signals::AlarmState::LatchedUnacknowledged);
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

}  // namespace orbwatch::app::pipeline
