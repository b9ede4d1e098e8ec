#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include "hal/back_off.h"
#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Between two probes of an open line: kernels before 6.6 do not signal the removal of a chip, and
/// an output that is held is not heard of otherwise.
inline constexpr Clock::duration kLineCheckPeriod = std::chrono::seconds(1);

/// When a line that failed is opened again, and what is told of it: a change of its fault or of the
/// reason. Thread-bound: the line thread.
class LineRetry {
 public:
  using OnFault = std::function<void(const LineFaultReport&)>;

  explicit LineRetry(OnFault on_fault) : on_fault_(std::move(on_fault)) {}

  /// The line cannot be opened.
  void refused(const Error& error, TimePoint now) { failed({LineFault::Gone, error.message}, now); }
  /// The line failed, and is closed.
  void failed(const LineFaultReport& report, TimePoint now) {
    due_ = now + pause_.next();
    tell(report);
  }
  /// The line is open.
  void works() {
    pause_.reset();
    tell({});
  }

  /// Of the next attempt.
  TimePoint due() const { return due_; }

 private:
  void tell(const LineFaultReport& report) {
    if (report.fault == told_.fault && report.detail == told_.detail) return;
    told_ = report;
    on_fault_(report);
  }

  OnFault on_fault_;
  LineFaultReport told_;
  TimePoint due_ = TimePoint::max();
  BackOff pause_;
};

}  // namespace orbwatch::hal
