// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/pipeline.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app::pipeline {

/// Camera whose settable exposure time is the brightness of its pictures. Like with a sensor, some
/// exposures after a setting still have the previous one.
class SettableCamera : public HandCamera {
 public:
  explicit SettableCamera(std::size_t delay)
      : HandCamera("thermal", PixelFormat::Y16), delay_(delay) {}

  /// Applies settings at once, like at a camera's start.
  void take_on() {
    const std::lock_guard lock(mutex_);
    waiting_ = 0;
  }
  /// Delivers a frame whose exposure begins now.
  void expose_as_set() {
    std::uint16_t bright = 0;
    hal::TimePoint moment;
    {
      const std::lock_guard lock(mutex_);
      if (waiting_ == 0) exposure_ = set_;
      waiting_ -= waiting_ > 0 ? 1 : 0;
      bright = exposure_;
      moment = hal::Clock::now();
    }
    expose(bright, moment);
  }
  /// Refuses settings from now on, as a device that is not there.
  void unplug() {
    is_connected_ = false;
    act([this] {
      keep_controls();
      report(hal::Fault::Unplugged);
    });
  }
  void plug() {
    is_connected_ = true;
    act([this] { EXPECT_TRUE(set_kept()); });
  }
  /// Waits until the exposure has been set that often. False: it was not in time.
  bool wait_for_settings(std::size_t count, hal::Clock::duration patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return settings_ >= count; });
  }

 private:
  Result<> do_set(std::string_view control, double value) override {
    if (control != "ExposureTime") return Camera::do_set(control, value);
    if (!is_connected_) return fail("is not connected");
    std::this_thread::sleep_for(std::chrono::microseconds(200));  // delay of its driver
    const std::lock_guard lock(mutex_);
    set_ = static_cast<std::uint16_t>(value);
    waiting_ = delay_;
    ++settings_;
    changed_.notify_all();
    return {};
  }
  std::size_t control_delay() const override { return delay_; }

  const std::size_t delay_;
  std::atomic<bool> is_connected_ = true;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t settings_ = 0;
  std::uint16_t set_ = 0;
  std::uint16_t exposure_ = 0;
  std::size_t waiting_ = 0;  ///< exposures that do not have the new setting yet
};

inline constexpr std::size_t kSeen = 0;  ///< the display view; those of recipes come after it

/// Calls the examining function, one call at a time; the test waits for an expected status.
class ExaminingSink : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  PictureNeeds needs(std::size_t, hal::TimePoint) override { return need_of(PixelFormat::Rgb); }
  void accept(const ViewPtr& view) override {
    const std::lock_guard lock(mutex_);
    if (on_view) on_view(*view);
    if (view->index == kSeen) seen_set_ = view->frame_set;
    changed_.notify_all();
  }
  void accept(const Status& status) override {
    const std::lock_guard lock(mutex_);
    if (on_status) on_status(status);
    status_ = status;
    changed_.notify_all();
  }
  void accept_event(const AlarmNotice& notice) override {
    const std::lock_guard lock(mutex_);
    if (on_notice) on_notice(notice);
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
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return seen_set_ == set; }));
  }

  // Set before the pipeline starts.
  std::function<void(const View&)> on_view;
  std::function<void(const Status&)> on_status;
  std::function<void(const AlarmNotice&)> on_notice;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Status status_;
  std::uint64_t seen_set_ = 0;
};

inline constexpr std::uint32_t kChecksum = 0xC0FFEE01;

class MeasuredPipeline : public testing::Test {
 protected:
  /// Scale and exposure of each recipe.
  static double scale(std::uint16_t recipe) { return 0.05 - 0.01 * recipe; }
  static double exposure(std::uint16_t recipe) { return 31000 + 5000 * recipe; }
  static double celsius(std::uint16_t recipe) { return exposure(recipe) * scale(recipe) - 273.15; }

  static RecipePlan plan(std::uint16_t number) {
    return recipe_plan(thermal_view(number, "measured_" + std::to_string(number)), 30000,
                       scale(number), number);
  }
  static RecipePlan plan_with_exposure(std::uint16_t number) {
    RecipePlan measured = plan(number);
    measured.controls.push_back({{"camera", 0}, "ExposureTime", exposure(number)});
    return measured;
  }

  void start(std::vector<RecipePlan> recipes, std::size_t control_delay = 0) {
    make(std::move(recipes), control_delay);
    ASSERT_TRUE(pipeline->start({&sink}));
  }
  /// Makes a pipeline that the test starts; its camera is set as the first recipe says.
  void make(std::vector<RecipePlan> recipes, std::size_t control_delay = 0) {
    PipelinePlan plan;
    auto hand = std::make_unique<SettableCamera>(control_delay);
    plan.formats.push_back(hand->configure({}).value());
    camera = hand.get();
    EXPECT_TRUE(camera->set("ExposureTime", exposure(1)));
    camera->take_on();
    plan.cameras.push_back(std::move(hand));
    plan.deadline = std::chrono::seconds(20);
    plan.workers = 1;
    plan.configuration_checksum = kChecksum;
    plan.views.push_back(thermal_view(kSeen, "seen"));
    plan.view_count = 1 + recipes.size();
    plan.colour_maps = {colour_map_table("grey"), colour_map_table("hot")};
    for (RecipePlan& recipe : recipes) plan.recipes.push_back(compiled(std::move(recipe)));
    pipeline.emplace(std::move(plan));
  }
  /// Status of the next frame, whose pictures have come, too.
  Status next_frame() {
    camera->expose_as_set();
    const Status measured =
        sink.wait_for([n = ++frames](const Status& status) { return status.frame_set == n; });
    sink.wait_for_pictures(frames);
    return measured;
  }
  ExaminingSink sink;  // outlives the pipeline
  SettableCamera* camera = nullptr;
  std::optional<Pipeline> pipeline;
  std::uint64_t frames = 0;
};

}  // namespace orbwatch::app::pipeline
