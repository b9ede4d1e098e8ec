#pragma once

#include <chrono>
#include <optional>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Edges as they come from a line, made edges to act on. With a period it debounces: a level counts
/// once it has been kept for that long, and the edge to it is stamped with the moment it was taken.
/// Without one (or when the kernel debounces) each edge passes at once, as the opposite of the one
/// before: the kernel names an edge by the level it finds some microseconds later, so that of a
/// short pulse both edges may be named alike. Either way the level is asked for again after a
/// burst, since queues overflow: what comes out last agrees with the line. Pure; time comes in with
/// the edges.
class EdgeFilter {
 public:
  /// How long after the last edge the level is asked for when nothing is debounced.
  static constexpr Clock::duration kQuiet = std::chrono::milliseconds(5);

  EdgeFilter(Clock::duration period, bool level)
      : period_(period), level_(level), last_{edge_to(level), {}} {}

  /// The next edge of the line, in order. Gives the edge that counts because of it: this one, or
  /// one before that had been kept for long enough.
  std::optional<EdgeEvent> take(const EdgeEvent& edge);

  /// When settle() wants the level; TimePoint::max(): not before another edge.
  TimePoint due() const { return due_; }

  /// The line's level, asked for at `now`, not before due(), when no edge was left to take. Gives
  /// the edge that counts because of it. A level that the last edge does not lead to may belong to
  /// an edge still on its way: it is believed when it is the same a period later.
  std::optional<EdgeEvent> settle(bool level, TimePoint now);

  /// Edges that were lost on the way, found by the level after a burst.
  std::uint64_t found_lost() const { return found_lost_; }

 private:
  Clock::duration wait() const { return period_.count() > 0 ? period_ : kQuiet; }
  std::optional<EdgeEvent> change_to(bool level, TimePoint stamp);

  Clock::duration period_;
  bool level_;  ///< as the edges that were given out say
  EdgeEvent last_;
  TimePoint due_ = TimePoint::max();
  bool doubted_ = false;
  std::uint64_t found_lost_ = 0;
};

}  // namespace orbwatch::hal
