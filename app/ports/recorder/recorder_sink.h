// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "app/model/sink/sink.h"
#include "app/ports/recorder/events/event_recorder.h"
#include "app/ports/recorder/log_file.h"
#include "app/ports/recorder/recorder_settings.h"
#include "app/ports/recorder/recorder_statistics.h"
#include "app/ports/recorder/recording_folder.h"
#include "hal/back_off.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Records signals, alarms and machine state of every frame set into files of an hour, on a thread
/// of its own, and events with pictures: no frame set waits for the disk, and every loss is
/// counted. A disk that is full, read-only, gone or silent for 10 s is a fault; recording goes on
/// when the disk does. Pinned events that leave less than a quarter of limit_mib are a fault in the
/// statistics alone, because recording goes on. A power cut costs at most the last second. Thread
/// rule: as Sink; request_event() and statistics() on any thread.
class RecorderSink final : public Sink {
 public:
  /// `texts` are attached to every recording. `cameras` by index, for events.
  RecorderSink(RecorderSettings settings, StatusNames names, RecordedTexts texts,
               std::vector<RecordedCamera> cameras = {});
  ~RecorderSink() override { stop(); }

  /// Starts the thread, which prepares the folder and tries again while that fails.
  Result<> start() override;
  /// Records what has arrived, also events that wait for a frame set, and finishes the file. After
  /// the last accept().
  void stop() override { thread_.stop(); }
  bool works() const override;
  std::chrono::nanoseconds cpu_time() const override { return thread_.cpu_time(); }
  std::vector<InterfaceMetric> metrics() const override;

  void accept_format(std::size_t camera, const hal::StreamFormat& format) override;
  void accept_frames(const hal::FrameSet& set) override;
  void accept(const ViewPtr&) override {}  // the cameras' own pictures are recorded
  void accept(const Status& status) override;
  void accept_event(const AlarmNotice& notice) override;

  /// Records an event with pictures around the next frame set, see recorder::EventTriggers. False:
  /// none are configured.
  bool request_event();

  recorder::RecorderStatistics statistics() const;

 private:
  /// Four seconds of 30 frame sets a second.
  static constexpr std::size_t kMostStates = 128;
  static constexpr std::size_t kMostEvents = 8 * signals::kMaxAlarms;

  struct StampedState {
    Status status;
    recorder::Utc stamp{};
  };
  struct StampedEvent {
    AlarmNotice notice;
    recorder::Utc stamp{};
  };

  void run();
  hal::TimePoint next_wake() const;
  void record_all();
  Result<bool> record_round(hal::TimePoint now);
  Result<> record();
  Result<> keep(recorder::LogMessage message, std::uint64_t& unflushed);
  Result<> begin();
  Result<> flush(hal::TimePoint now);
  Result<> make_room(const std::filesystem::path& log, recorder::Utc utc);
  void end();
  void count_flushed();
  void give_up(const std::string& reason);

  const RecorderSettings settings_;
  const StatusNames names_;
  const RecordedTexts texts_;

  // Shared by the pipeline's thread and the recorder's.
  hal::BoundedQueue<StampedState, kMostStates> states_;
  hal::BoundedQueue<StampedEvent, kMostEvents> events_;
  std::uint64_t last_set_ = 0;  ///< the pipeline's

  hal::TimePoint started_{};
  std::atomic<bool> has_fault_{false};
  std::atomic<bool> has_pin_fault_{false};
  std::atomic<hal::TimePoint> busy_since_{hal::TimePoint{}};  ///< the epoch: waits for work
  recorder::RecorderCounters counters_;
  std::optional<recorder::EventRecorder> pictures_;  ///< of events

  // The recorder's thread's.
  recorder::RecordingFolder folder_;
  bool is_prepared_ = false;
  std::optional<recorder::LogFile> file_;
  hal::TimePoint next_flush_{}, next_file_{}, next_try_{};
  std::uint64_t known_size_ = 0;  ///< of the file, as counted
  std::uint64_t unflushed_states_ = 0, unflushed_events_ = 0;
  hal::BackOff back_off_;
  std::string fault_;  ///< logged last; empty: none
  hal::Thread thread_;
};

}  // namespace orbwatch::app
