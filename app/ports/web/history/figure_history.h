// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/status/status_report.h"
#include "app/ports/web/history/extremes.h"
#include "hal/clock.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::web {

/// The last ten minutes of every figure of regions, and of the watch figures of cameras: extremes
/// of each half second. Memory is allocated when a region or a camera is first seen, and does not
/// grow after that. When the recipe changes, regions that it does not have are dropped, and the
/// others continue. Thread-safe; accept() waits at most for a copy of a few kilobytes.
class FigureHistory {
 public:
  static constexpr std::chrono::milliseconds kStep{500};
  static constexpr std::size_t kSteps = 1200;

  /// One figure, oldest step first; a step without a measurement is NaN.
  struct Series {
    std::string_view unit;
    std::vector<Extremes> steps;
    hal::TimePoint end;  ///< end of the newest step; the epoch: none
  };

  explicit FigureHistory(StatusNames names) : names_(std::move(names)) {}

  /// Adds a status; for the pipeline's thread, allocates nothing.
  void accept(const Status& status);

  /// Ends each step that is over by `now`. If several steps end at once, the first one gets all
  /// values since the last call and the others are not measured. On one thread.
  void advance(hal::TimePoint now);

  /// Series of the component of this kind, "region" or "camera", and name; empty while it has not
  /// been seen. Nullopt: unknown component or figure.
  std::optional<Series> series(const Component& component, std::string_view figure) const;

  /// The components with a history.
  std::vector<Component> components() const;

  /// Names of the figures of this kind of component, in the order of the status.
  static std::vector<std::string_view> figure_names(std::string_view kind);

  /// Series of a process before, which ended together; unknown figures are left out.
  struct Kept {
    Component component;
    std::map<std::string, std::vector<Extremes>>
        figures;  ///< as many steps of each, at most kSteps
  };
  /// Continues them: the time from `end` to `now` is a gap. At most as many regions and cameras as
  /// there can be; before the first advance().
  void resume(const std::vector<Kept>& kept, hal::TimePoint end, hal::TimePoint now);

 private:
  struct Track {
    Component component;
    std::vector<Extremes> steps;  ///< indexed by field, then by place in the ring
  };

  bool is_configured(const Component& component) const;
  void begin(hal::TimePoint now);
  void follow(const StatusExtremes& seen);
  void follow(std::vector<Track>& next, Component component, std::size_t figures);
  void end_step(const StatusExtremes& seen);
  void end_gap(hal::TimePoint now);

  const StatusNames names_;
  mutable hal::PriorityMutex adding_;  ///< guards the open step
  StatusExtremes open_;
  /// Guards the following members; the pipeline's thread never locks it.
  mutable std::mutex reading_;
  std::vector<Track> tracks_;  ///< regions, then cameras
  std::size_t next_ = 0;       ///< index of the next step
  std::size_t count_ = 0;      ///< number of steps
  hal::TimePoint end_;         ///< end of the newest step, or the beginning of the first
};

}  // namespace orbwatch::app::web
