// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include "hal/back_off.h"
#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Interval between probes of an open line: kernels before 6.6 do not signal the removal of a chip,
/// and an output that keeps its level would otherwise not detect it.
inline constexpr Clock::duration kLineCheckPeriod = std::chrono::seconds(1);

/// Decides when a failed line is opened again, and reports each change of its fault or of the
/// reason. Thread-bound: the line thread.
class LineRetry {
 public:
  using OnFault = std::function<void(const LineFaultReport&)>;

  explicit LineRetry(OnFault on_fault) : on_fault_(std::move(on_fault)) {}

  /// Call when the line cannot be opened.
  void refused(const Error& error, TimePoint now) { failed({LineFault::Gone, error.message}, now); }
  /// Call when the line failed and was closed.
  void failed(const LineFaultReport& report, TimePoint now) {
    due_ = now + pause_.next();
    report_change(report);
  }
  /// Call when the line is open.
  void works() {
    pause_.reset();
    report_change({});
  }

  /// Moment of the next attempt.
  TimePoint due() const { return due_; }

 private:
  void report_change(const LineFaultReport& report) {
    if (report.fault == reported_.fault && report.detail == reported_.detail) return;
    reported_ = report;
    on_fault_(report);
  }

  OnFault on_fault_;
  LineFaultReport reported_;
  TimePoint due_ = TimePoint::max();
  BackOff pause_;
};

}  // namespace orbwatch::hal
