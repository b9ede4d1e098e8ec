// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/ports/recorder/events/event_recorder.h"
#include "tests/app/ports/recorder/events/jpeg_frame.h"
#include "tests/app/ports/recorder/events/painted_frame.h"

namespace orbwatch::tests {

/// A machine with a thermal and a colour camera whose events are recorded, on one thread: each
/// frame set goes the way of the pipeline. Its time is the test's, a set every 10 ms unless some
/// are left out.
class RecordedMachine {
 public:
  static constexpr int kWidth = 24, kHeight = 16;
  static constexpr hal::recording::PictureRegion kBall{3, 2, 11, 9};
  static constexpr std::size_t kButton = 1;  ///< index of the process input "button"

  explicit RecordedMachine(const app::RecorderSettings& settings)
      : settings_(settings), recorder_(settings_, cameras(), names_, texts_, counters_) {}

  static std::vector<app::RecordedCamera> cameras() {
    hal::StreamFormat thermal;
    thermal.format = PixelFormat::Y16;
    thermal.width = kWidth;
    thermal.height = kHeight;
    hal::StreamFormat colour = thermal;
    colour.format = PixelFormat::Nv12;
    return {{"thermal", thermal, kBall, {}}, {"colour", colour, {0, 0, kWidth, kHeight}, {}}};
  }

  static hal::TimePoint at(std::uint64_t number) {
    return start() + std::chrono::milliseconds(10) * number +
           std::chrono::microseconds(number * 37 % 3000);
  }

  /// First and last frame set within a window around a set.
  static std::uint64_t first_of(std::uint64_t set, std::chrono::milliseconds before) {
    std::uint64_t first = set;
    while (first > 1 && at(first - 1) >= at(set) - before) --first;
    return first;
  }
  static std::uint64_t last_of(std::uint64_t set, std::chrono::milliseconds after) {
    std::uint64_t last = set;
    while (at(last + 1) <= at(set) + after) ++last;
    return last;
  }

  /// The pipeline's part of frame set `number`: every third has no new colour frame.
  void pass(std::uint64_t number, bool is_alarm = false) {
    hal::FrameSet set;
    set.id = number;
    set.stamp = at(number);
    set.frames[0] = painted_frame(number, 0, at(number), kWidth, kHeight);
    set.held[1] = number % 3 == 0;
    set.frames[1] = sends_jpeg
                        ? jpeg_frame(number, at(number), kWidth, kHeight)
                        : painted_frame(number, 1, at(number), kWidth, kHeight, PixelFormat::Nv12);
    recorder_.accept_frames(set);
    status.frame_set = number;
    status.stamp = set.stamp;
    if (is_alarm) alarm(number);
    recorder_.accept(status, set.stamp);
    waiting_.push_back(status);
  }

  /// The pipeline's part without a new frame set.
  void idle(hal::TimePoint now) { recorder_.accept(status, now); }

  /// The recorder's part. True: more pictures wait.
  Result<bool> record() {
    auto done = recorder_.begin_round();
    for (const app::Status& one : waiting_) {
      const app::StatusReport report{one, names_, one.stamp, hal::to_utc(one.stamp)};
      if (done) done = recorder_.keep(app::recorder::state_message(report));
    }
    waiting_.clear();
    if (!done) return tl::unexpected(done.error());
    return recorder_.end_round();
  }
  void record_all() {
    for (bool is_more = true; is_more;) {
      const auto recorded = record();
      ASSERT_TRUE(recorded) << recorded.error().message;
      is_more = *recorded;
    }
  }

  app::recorder::RecorderStatistics statistics() const {
    auto statistics = counters_.read();
    recorder_.add_figures(statistics);
    return statistics;
  }
  app::recorder::EventRecorder& recorder() { return recorder_; }
  std::vector<app::recorder::StoredEvent> events() const {
    const auto listed = app::recorder::EventFolder(settings_.folder).list();
    EXPECT_TRUE(listed);
    return listed.value_or(std::vector<app::recorder::StoredEvent>());
  }

  app::Status status;
  bool sends_jpeg = false;  ///< the colour camera sends JPEG, see jpeg_frame()

 private:
  /// Ahead of the clock, which therefore ends no event.
  static hal::TimePoint start() {
    static const hal::TimePoint begun = hal::Clock::now() + std::chrono::hours(1);
    return begun;
  }

  void alarm(std::uint64_t number) {
    app::AlarmNotice notice;
    notice.frame_set = number;
    notice.stamp = at(number);
    notice.part = *app::PartName::make("Flügel 7");
    notice.layer = 12;
    notice.signal = app::SignalNumber{5};  // hot_spot_width
    notice.event.level = signals::AlarmLevel::HighAlarm;
    notice.event.value = 27.25;
    recorder_.accept_event(notice);
  }

  const app::RecorderSettings settings_;
  const app::StatusNames names_{{"thermal", "colour"}, {}, {}, {"door", "button"}};
  const app::RecordedTexts texts_{{{"site.toml", "rig = \"rig.toml\""}}, {{"orbwatch", "0.1.0"}}};
  app::recorder::RecorderCounters counters_;
  app::recorder::EventRecorder recorder_;
  std::vector<app::Status> waiting_;
};

}  // namespace orbwatch::tests
