// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/status/alarm_notice.h"
#include "app/model/status/status.h"
#include "app/ports/recorder/events/event_settings.h"
#include "app/ports/recorder/events/frame_ring.h"
#include "hal/thread/bounded_queue.h"

namespace orbwatch::app::recorder {

/// Kind of a cause.
enum class TriggerKind : std::uint8_t { Alarm, Command, Laser, Layer, Line };
inline constexpr std::array kTriggerKinds{TriggerKind::Alarm, TriggerKind::Command,
                                          TriggerKind::Laser, TriggerKind::Layer,
                                          TriggerKind::Line};

/// Name in files and folders.
constexpr std::string_view name_of(TriggerKind kind) {
  switch (kind) {
    case TriggerKind::Alarm:
      return "alarm";
    case TriggerKind::Command:
      return "command";
    case TriggerKind::Laser:
      return "laser_on";
    case TriggerKind::Layer:
      return "layer";
    case TriggerKind::Line:
      return "line";
  }
  return {};
}

/// Text for operators; that of an alarm is its notice's, and that of a line has its name.
constexpr std::string_view text_of(TriggerKind kind) {
  switch (kind) {
    case TriggerKind::Alarm:
      return "alarm raised";
    case TriggerKind::Command:
      return "by command";
    case TriggerKind::Laser:
      return "the laser went on";
    case TriggerKind::Layer:
      return "the layer changed";
    case TriggerKind::Line:
      return "a line became active";
  }
  return {};
}

/// Cause of an event, with its circumstances.
struct Trigger {
  TriggerKind kind = TriggerKind::Command;
  hal::TimePoint stamp;  ///< of the newest frame set at that time
  std::uint64_t frame_set = 0;
  std::uint16_t recipe = 0;
  PartName part;
  double layer = signals::kNotValid;
  AlarmNotice notice{};  ///< of an alarm
  std::size_t line = 0;  ///< index in EventSettings::on_lines, of a line
};

/// An event that is to be recorded, from the pipeline's thread to the recorder's.
struct StartedEvent {
  FrameRing::Window window;
  Trigger trigger;
  hal::TimePoint first;  ///< of the window
};

/// Decides when events begin and end, by the stamps of frame sets. A trigger during an event
/// extends it, up to its longest time; the next one begins an event of its own, which may overlap
/// and shares its pictures in the ring. So each trigger has its whole time in one event.
/// Thread rule: request, extended and refused on any thread; the rest on the pipeline's, and
/// fire_waiting after its end on another one.
class EventTriggers {
 public:
  using Started = hal::BoundedQueue<StartedEvent, 2 * FrameRing::kMostWindows>;

  /// The settings, the ring and the queue are the caller's and outlive this. `process_inputs`:
  /// names by index in a Status, among which are the settings' lines.
  EventTriggers(const EventSettings& settings, const std::vector<std::string>& process_inputs,
                FrameRing& ring, Started& started);

  /// Triggers by the next frame set, see accept().
  void request() { is_requested_ = true; }

  /// Before the pictures of a frame set are put into the ring.
  void begin_set(hal::TimePoint stamp) { end_before(stamp); }
  void accept(const AlarmNotice& notice);
  /// A command and edges between two frame sets belong to the next one; without one for longer than
  /// settings.after, and at least 2 s, since the first of them, to the newest. `now` also ends
  /// events while there are no frame sets.
  void accept(const Status& status, hal::TimePoint now);
  /// Triggers what waits by the newest frame set; without any, it waits on.
  void fire_waiting();

  /// Triggers that extended an event, and those that found no window, since start.
  std::uint64_t extended() const { return extended_; }
  std::uint64_t refused() const { return refused_; }

 private:
  struct Running {
    std::size_t window = 0;
    hal::TimePoint first, last;
  };
  struct WatchedLine {
    std::size_t input = 0;               ///< index in a Status
    std::optional<std::uint32_t> edges;  ///< last reported count
    std::uint32_t waiting = 0;           ///< edges that wait for a frame set
  };

  void collect(const Status& status);
  bool has_cause() const;
  bool is_due(bool is_new_set, hal::TimePoint now);
  void fire_lines();
  void fire_at_newest(TriggerKind kind, std::size_t line = 0);
  void fire(const Trigger& trigger);
  bool extends_newest(hal::TimePoint last);
  void end_before(hal::TimePoint moment);
  static Trigger trigger_at(const Status& status);

  const EventSettings& settings_;
  FrameRing& ring_;
  Started& started_;
  std::atomic<bool> is_requested_{false};
  std::array<Running, FrameRing::kMostWindows> running_;  ///< the first count_, oldest first
  std::size_t count_ = 0;
  /// Trigger at the newest status, without a cause; frame set 0: there is none yet.
  Trigger newest_;
  std::optional<hal::TimePoint> waits_since_;  ///< first of the causes that wait for a frame set
  bool is_laser_ = false, is_layer_ = false;   ///< such causes, if the settings have them
  double laser_ = signals::kNotValid, layer_ = signals::kNotValid;  ///< last ones known
  std::vector<WatchedLine> lines_;                                  ///< those of the settings
  std::atomic<std::uint64_t> extended_{0}, refused_{0};
};

}  // namespace orbwatch::app::recorder
