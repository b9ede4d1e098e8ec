// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "app/model/sink/recorded_camera.h"
#include "app/model/sink/recorded_texts.h"
#include "app/model/status/status_report.h"
#include "app/ports/recorder/events/event_file.h"
#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_settings.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/events/event_triggers.h"
#include "app/ports/recorder/events/frame_ring.h"
#include "app/ports/recorder/recorder_settings.h"
#include "app/ports/recorder/recorder_statistics.h"
#include "hal/sync/frame_set.h"

namespace orbwatch::app::recorder {

/// Records events with pictures. On the pipeline's thread pictures are copied into the ring and
/// triggers are decided; the recorder's thread codes the pictures of events and writes them, in
/// rounds, so that messages do not wait for pictures:
///
///     events.begin_round();
///     for (LogMessage& message : all that wait) events.keep(std::move(message));
///     is_more = events.end_round();
///
/// Thread rule: accept_format, accept_frames, accept_event and accept on the pipeline's thread;
/// request and add_figures on any; the rest on the recorder's, fire_waiting once the pipeline's
/// has ended.
class EventRecorder {
 public:
  /// `cameras` by index in the frame sets; `counters` are the caller's.
  EventRecorder(const RecorderSettings& settings, std::vector<RecordedCamera> cameras,
                const StatusNames& names, const RecordedTexts& texts, RecorderCounters& counters);

  void accept_format(std::size_t camera, const hal::StreamFormat& format);
  void accept_frames(const hal::FrameSet& set);
  void accept_event(const AlarmNotice& notice) { triggers_.accept(notice); }
  void accept(const Status& status, hal::TimePoint now = hal::Clock::now()) {
    triggers_.accept(status, now);
  }

  /// Begins an event by command.
  void request() { triggers_.request(); }
  void add_figures(RecorderStatistics& statistics) const;

  /// Triggers what waits for a frame set, because none comes any more. Before the last rounds.
  void fire_waiting() { triggers_.fire_waiting(); }
  /// Begins the events that were triggered. Error: the disk.
  Result<> begin_round();
  /// Keeps a message for later events, and writes it into those that run. Error: the disk.
  Result<> keep(LogMessage message);
  /// Writes one picture of each event, and finishes those that are over. True: more pictures wait.
  /// Error: the disk.
  Result<bool> end_round();
  /// Hands everything to the disk. Error: the disk.
  Result<> flush();
  /// Finishes all events as they are. Error: the disk.
  Result<> end();
  /// Leaves all events after an error of the disk, and drops the triggers that wait; the folder
  /// finishes what is there.
  void give_up();

 private:
  struct Running {
    std::size_t window = 0;
    bool is_over = false;
    hal::TimePoint first;  ///< of the window
    hal::TimePoint triggered;
    std::optional<hal::TimePoint> first_set, last_set;  ///< that have pictures
    std::filesystem::path folder;
    EventFile file;
    EventSummary summary;
    std::uint64_t left_out = 0;    ///< pictures, see EventFile::write()
    std::uint64_t known_size = 0;  ///< as counted
    bool has_picture = false;      ///< of the trigger
  };

  void put(const hal::FrameSet& set, std::size_t camera);
  Result<> begin(const StartedEvent& started);
  std::string cause_of(const Trigger& trigger) const;
  EventSummary summary_of(const Trigger& trigger, Utc triggered) const;
  Result<> write_next(Running& event);
  Result<> write_trigger_picture(Running& event, const KeptFrame& frame);
  Result<> finish(Running& event, bool is_interrupted);
  void count_bytes(Running& event);

  const EventSettings settings_;
  const std::vector<RecordedCamera> cameras_;
  std::vector<hal::StreamFormat> delivered_;  ///< formats by camera; the pipeline's thread's
  const std::vector<bool> is_recorded_;       ///< by camera
  const StatusNames& names_;
  const RecordedTexts& texts_;
  RecorderCounters& counters_;
  FrameRing ring_;
  EventTriggers::Started started_;
  EventTriggers triggers_;

  // The recorder's thread's.
  EventFolder folder_;
  std::deque<LogMessage> recent_;  ///< for events to come
  std::list<Running> running_;
  JpegEncoder jpeg_;
};

}  // namespace orbwatch::app::recorder
