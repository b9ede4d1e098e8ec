#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "app/model/status_report.h"
#include "app/ports/web/history/extremes.h"
#include "hal/clock.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::web {

/// The last ten minutes of every figure of regions, and of what is watched of cameras: its extremes
/// in each half second. Its memory is taken when a region or a camera is seen first, and does not
/// grow after that. When the recipe changes, regions that it does not have are forgotten, and those
/// that it has go on. Thread-safe; accept() waits for a copy of a few kilobytes at most.
class FigureHistory {
 public:
  static constexpr std::chrono::milliseconds kStep{500};
  static constexpr std::size_t kSteps = 1200;

  /// One figure, oldest step first; a step without a measurement is NaN.
  struct Series {
    std::string_view unit;
    std::vector<Extremes> steps;
    hal::TimePoint end;  ///< of the newest step; the epoch: there is none
  };

  explicit FigureHistory(StatusNames names) : names_(std::move(names)) {}

  /// For the pipeline's thread: allocates nothing.
  void accept(const Status& status);

  /// Ends each step that is over by `now`. Those that nobody ended in time are not measured, but
  /// for the first one, which has all since the last call. By one thread.
  void advance(hal::TimePoint now);

  /// Of the component of this kind, "region" or "camera", and name; empty while it is not seen.
  /// Nullopt: there is no such component or figure.
  std::optional<Series> series(const Component& component, std::string_view figure) const;

  /// Those that there are.
  std::vector<Component> components() const;

 private:
  struct Track {
    Component component;
    std::vector<Extremes> steps;  ///< by field, then by place in the ring
  };

  bool is_configured(const Component& component) const;
  void begin(hal::TimePoint now);
  void follow(const StatusExtremes& seen);
  void follow(std::vector<Track>& next, Component component, std::size_t figures);
  void end_step(const StatusExtremes& seen);

  const StatusNames names_;
  mutable hal::PriorityMutex adding_;  ///< of the open step
  StatusExtremes open_;
  mutable std::mutex reading_;  ///< of what follows; the pipeline's thread never locks it
  std::vector<Track> tracks_;   ///< regions, then cameras
  std::size_t next_ = 0;        ///< place of the next step
  std::size_t count_ = 0;       ///< of steps
  hal::TimePoint end_;          ///< of the newest step, or the beginning of the first
};

}  // namespace orbwatch::app::web
