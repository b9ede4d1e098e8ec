// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "hal/lines/line.h"
#include "hal/lines/line_task.h"
#include "hal/thread/priority_mutex.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Selection of a camera's frames by triggers. Off: all frames. Software: an edge makes the camera
/// expose. Line: the camera is connected to the trigger line itself, or runs freely; the edge
/// stamps the frame.
enum class TriggerMode : std::uint8_t { Off, Software, Line };

/// Edges that are triggers.
enum class TriggerActivation : std::uint8_t { RisingEdge, FallingEdge, AnyEdge };

struct TriggerSettings {
  TriggerMode mode = TriggerMode::Line;
  TriggerActivation activation = TriggerActivation::RisingEdge;
  Clock::duration delay{0};  ///< from the edge to the exposure
  /// Mode Software: an exposure request without a frame for this long has failed. Line: an edge
  /// this long before an exposure belongs to no frame; it is from an outage of the camera.
  Clock::duration timeout = std::chrono::seconds(1);
};

/// Trigger that a frame belongs to.
struct TriggerStamp {
  std::uint64_t id = 0;  ///< number of the trigger, counted from 1
  TimePoint edge;
};

/// Counts by fate; at any moment triggers = frames + missed + waiting.
struct TriggerCounts {
  std::uint64_t triggers = 0;  ///< edges that are triggers
  std::uint64_t frames = 0;    ///< frames with a trigger
  std::uint64_t missed = 0;    ///< triggers without a frame: too fast for the camera, or its fault,
                               ///< or the frame is damaged
  std::uint64_t waiting = 0;   ///< triggers whose frame may still arrive, at most kMaxWaiting
  std::uint64_t untriggered = 0;  ///< frames without a trigger
};

/// Joins the edges of a trigger line with the frames of one camera.
/// A frame belongs to the newest trigger (edge plus delay) at or before its exposure's start, or to
/// the next one if that is nearer and less than kStampError after it; earlier triggers without a
/// frame are missed. In mode Software the camera is triggered when the trigger is due, unless the
/// previous frame is outstanding: then the trigger is missed.
/// Bounded: beyond kMaxWaiting triggers the oldest is missed if a later one is due, since a frame
/// belongs to the newest before it; else the newest, since the others still get their frames. In
/// mode Software the newest, since the camera is to expose for the others first.
/// Thread rule: on_edge on the line thread; due and run on a LineThread of its own in mode
/// Software, since a camera may be slow to answer; claim and miss on the camera's, fire, abandon
/// and counts on any.
class FrameTrigger : public LineTask {
 public:
  static constexpr std::size_t kMaxWaiting = 32;
  /// Error of the start of an exposure that a line began: interrupts are stamped late, and the
  /// exposure time that was subtracted is rounded. Half a period at the highest rate.
  static constexpr std::chrono::microseconds kStampError{500};
  using Expose = std::function<Result<>()>;

  /// `expose` triggers the camera in mode Software; when it fails, the trigger is missed.
  FrameTrigger(const TriggerSettings& settings, Expose expose);

  /// Adds an edge of the line.
  void on_edge(const EdgeEvent& edge);

  /// Adds a trigger without an edge (GenICam TriggerSoftware).
  void fire(TimePoint moment);

  TimePoint due() const override;
  void run(TimePoint now) override;

  /// Returns the trigger of a frame; nullopt: it has none and is to be dropped.
  std::optional<TriggerStamp> claim(TimePoint exposure_start);

  /// Counts the trigger of a damaged frame as missed. False: it has none.
  bool miss(TimePoint exposure_start);

  /// Counts waiting triggers as missed, because the camera has a fault or is absent.
  void abandon();

  TriggerCounts counts() const;

 private:
  struct Waiting {
    TriggerStamp trigger;
    TimePoint moment;      ///< edge plus delay; once exposed, the exposure request
    bool exposed = false;  ///< Software: the camera was triggered
  };

  bool is_trigger(Edge edge) const;
  std::optional<TriggerStamp> take(TimePoint exposure_start);
  void miss_before(TimePoint oldest);
  bool may_have_begun(std::size_t next, TimePoint exposure_start) const;
  bool prepare_exposure(TimePoint now, std::uint64_t& id);
  void drop_oldest(std::size_t count);

  const TriggerSettings settings_;
  const Expose expose_;
  mutable PriorityMutex mutex_;
  std::array<Waiting, kMaxWaiting> waiting_;  ///< the first counts_.waiting ones, oldest first
  TriggerCounts counts_;
};

}  // namespace orbwatch::hal
