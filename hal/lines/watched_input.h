// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hal/lines/line.h"
#include "hal/lines/line_retry.h"
#include "hal/lines/line_task.h"
#include "hal/lines/process_input.h"

namespace orbwatch::hal {

/// Debounces edges and makes them alternate. With a period, a level counts once it was kept for
/// that long; its edge has the stamp of the change. Without one (or when the kernel debounces) each
/// edge passes at once, as the opposite of the previous edge: the kernel derives the direction from
/// a level that it reads some microseconds later, so both edges of a short pulse may have the same
/// one.
///
/// Queues overflow. Numbered edges show how many are lost, and therefore which level the next one
/// leads to. Other losses, and those without a number (an interrupt may represent three edges),
/// show in the level: it is confirmed with kReadings after each loss, however busy the line is, and
/// read again after a burst, so that the last edge agrees with the line. Pure: time is an argument.
class EdgeFilter {
 public:
  /// Time from the last edge to reading the level, without debounce.
  static constexpr Clock::duration kQuiet = std::chrono::milliseconds(5);

  /// Majority by which readings of one level after a loss must outnumber the others: a single one
  /// may belong to an edge that has not arrived.
  static constexpr int kReadings = 3;

  EdgeFilter(Clock::duration period, bool level)
      : period_(period), level_(level), last_{edge_to(level), {}} {}

  /// Adds the next edge of the line, in order. Returns the edge that counts now: this one, or an
  /// earlier one that was kept for long enough. An edge older than a level reading that replaced it
  /// came late (a busy kernel may need more than 10 ms): it changes nothing.
  std::optional<EdgeEvent> take(const EdgeEvent& edge);

  /// Moment at which settle() is to be called; TimePoint::max(): not before another edge.
  TimePoint due() const { return due_; }

  /// Adds the line's level at `now`, not before due(), with no edge left to take. Returns the edge
  /// that counts now. A level that contradicts the last edge may belong to an edge that has not
  /// arrived: it counts when it is the same a period later.
  std::optional<EdgeEvent> settle(bool level, TimePoint now);

  /// Reports that edges may have been lost without a number: the queue was full.
  void doubt();

  /// True if the level is to be read as soon as no edge waits, for confirm(). Never with a period.
  bool in_doubt() const { return in_doubt_; }

  /// Adds the line's level, read with no edge left to take. Returns the edge that replaces lost
  /// ones once the level contradicts them.
  std::optional<EdgeEvent> confirm(bool level, TimePoint now);

  /// Number of lost edges: by their numbers, and one for each that the level revealed, late or not
  /// at all.
  std::uint64_t lost() const { return lost_; }

 private:
  Clock::duration wait() const { return period_.count() > 0 ? period_ : kQuiet; }
  std::optional<EdgeEvent> change_to(bool level, TimePoint stamp);
  std::optional<EdgeEvent> make_up(bool level, TimePoint now);

  Clock::duration period_;
  bool level_;  ///< level after the newest returned edge
  EdgeEvent last_;
  TimePoint due_ = TimePoint::max();
  bool doubted_ = false;   ///< set by settle()
  bool in_doubt_ = false;  ///< set since a loss
  int readings_ = 0;       ///< readings since the loss: those that agreed minus those that did not
  TimePoint made_up_ = TimePoint::min();  ///< moment at which the level last revealed a lost edge
  std::uint64_t lost_ = 0;
};

/// Input line that forwards its debounced edges. A line that is missing, or fails later (a chip on
/// USB may disconnect), is a fault, and is opened again after a BackOff. Thread rule: thread-bound
/// (the line thread), apart from lost() and state().
class WatchedInput : public LineTask {
 public:
  using OnEdge = std::function<void(const EdgeEvent&)>;

  /// Opens the line of `back_end`, which must outlive it; `on_fault` is called when that fails.
  /// Edges alternate, starting from the level at that moment.
  WatchedInput(LineBackEnd& back_end, InputSettings settings, LineRetry::OnFault on_fault,
               TimePoint now);

  /// Debounced level; unknown while the line has a fault.
  std::shared_ptr<const ProcessInput> state() const { return state_; }

  /// Adds a receiver of edges; called before the line thread starts.
  void subscribe(OnEdge on_edge) { on_edge_.push_back(std::move(on_edge)); }

  /// Descriptor of the open line, else -1. A new file for each opened().
  int descriptor() const { return input_ ? input_->descriptor() : -1; }
  unsigned opened() const { return opened_; }

  /// Reads the waiting edges.
  void read(TimePoint now);

  TimePoint due() const override { return input_ ? std::min(filter_.due(), check_) : retry_.due(); }
  void run(TimePoint now) override;

  /// Edges that the kernel dropped before they were read.
  std::uint64_t lost() const { return lost_; }

 private:
  Result<> open_line();
  void open(TimePoint now);
  void count_lost();
  void forward(const std::optional<EdgeEvent>& edge);
  void fail_with(const LineFaultReport& report, TimePoint now);

  LineBackEnd& back_end_;
  InputSettings settings_;
  LineRetry retry_;
  std::vector<OnEdge> on_edge_;
  std::unique_ptr<DigitalInput> input_;
  EdgeFilter filter_{Clock::duration(0), false};
  std::optional<bool>
      level_;  ///< level after the newest forwarded edge; nullopt: it was never open
  std::shared_ptr<ProcessInput> state_ = std::make_shared<ProcessInput>();
  unsigned opened_ = 0;
  TimePoint check_ = TimePoint::min();  ///< moment at which the open line is probed next
  std::uint64_t lost_before_ = 0;       ///< lost edges of closed files
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace orbwatch::hal
