#pragma once

#include <chrono>
#include <optional>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Debounces edges and makes them alternate. With a period, a level counts once it was kept for
/// that long; its edge has the stamp of the change. Without one (or when the kernel debounces) each
/// edge passes at once, as the opposite of the one before: the kernel derives the direction from a
/// level that it reads some microseconds later, so both edges of a short pulse may have the same
/// one. As queues overflow, the level is read again after a burst, so that the last edge agrees
/// with the line. Pure: time is an argument.
class EdgeFilter {
 public:
  /// From the last edge to reading the level, without debounce.
  static constexpr Clock::duration kQuiet = std::chrono::milliseconds(5);

  EdgeFilter(Clock::duration period, bool level)
      : period_(period), level_(level), last_{edge_to(level), {}} {}

  /// The next edge of the line, in order. Returns the edge that counts now: this one, or an earlier
  /// one that was kept for long enough.
  std::optional<EdgeEvent> take(const EdgeEvent& edge);

  /// When settle() is to be called; TimePoint::max(): not before another edge.
  TimePoint due() const { return due_; }

  /// The line's level at `now`, not before due(), with no edge left to take. Returns the edge that
  /// counts now. A level that contradicts the last edge may belong to an edge that has not arrived:
  /// it counts when it is the same a period later.
  std::optional<EdgeEvent> settle(bool level, TimePoint now);

  /// Lost edges, as derived from the level after a burst.
  std::uint64_t found_lost() const { return found_lost_; }

 private:
  Clock::duration wait() const { return period_.count() > 0 ? period_ : kQuiet; }
  std::optional<EdgeEvent> change_to(bool level, TimePoint stamp);

  Clock::duration period_;
  bool level_;  ///< of the newest returned edge
  EdgeEvent last_;
  TimePoint due_ = TimePoint::max();
  bool doubted_ = false;
  std::uint64_t found_lost_ = 0;
};

}  // namespace orbwatch::hal
