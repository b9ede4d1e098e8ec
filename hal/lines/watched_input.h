#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/back_off.h"
#include "hal/lines/edge_filter.h"
#include "hal/lines/line_back_end.h"
#include "hal/lines/line_task.h"

namespace orbwatch::hal {

/// An input line that forwards its debounced edges. A line that fails (a chip on USB may
/// disconnect) is reported once, closed, and opened again after a BackOff. Thread rule:
/// thread-bound (the line thread), apart from lost().
class WatchedInput : public LineTask {
 public:
  using OnEdge = std::function<void(const EdgeEvent&)>;
  using OnFault = std::function<void(const LineFaultReport&)>;

  /// Opens the line of `back_end`, which must outlive it. Edges alternate, from initial_level() on.
  /// The error is open_input()'s.
  static Result<std::unique_ptr<WatchedInput>> open(LineBackEnd& back_end,
                                                    const InputSettings& settings,
                                                    OnFault on_fault);

  /// The level at the first open().
  bool initial_level() const { return initial_level_; }

  /// Adds a receiver of edges; called before the line thread starts.
  void subscribe(OnEdge on_edge) { on_edge_.push_back(std::move(on_edge)); }

  /// Of the open line, else -1. A new file for each opened().
  int descriptor() const { return input_ ? input_->descriptor() : -1; }
  unsigned opened() const { return opened_; }

  /// Reads the waiting edges.
  void read(TimePoint now);

  TimePoint due() const override { return input_ ? std::min(filter_.due(), check_) : retry_; }
  void run(TimePoint now) override;

  /// Edges that the kernel dropped before they were read.
  std::uint64_t lost() const { return lost_; }

 private:
  WatchedInput(LineBackEnd& back_end, InputSettings settings, OnFault on_fault);

  Result<> open_line();
  void count_lost();
  void forward(const std::optional<EdgeEvent>& edge);
  void fail_with(const LineFaultReport& report, TimePoint now);
  void reopen(TimePoint now);

  LineBackEnd& back_end_;
  InputSettings settings_;
  OnFault on_fault_;
  std::vector<OnEdge> on_edge_;
  std::unique_ptr<DigitalInput> input_;
  EdgeFilter filter_{Clock::duration(0), false};
  bool initial_level_ = false;
  bool level_ = false;  ///< of the newest forwarded edge
  unsigned opened_ = 0;
  TimePoint retry_ = TimePoint::max();
  TimePoint check_ = TimePoint::min();  ///< when the open line is probed next
  BackOff pause_;
  std::uint64_t lost_before_ = 0;  ///< of closed files
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace orbwatch::hal
