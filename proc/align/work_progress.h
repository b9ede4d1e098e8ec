// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string_view>
#include <utility>

#include "proc/image/result.h"

namespace orbwatch::align {

/// Step of an alignment that takes seconds.
enum class WorkStep : std::uint8_t {
  None = 0,
  Record = 1,
  Detect = 2,
  Features = 3,
  Light = 4,
  Edges = 5,
  Tags = 6,
  Solve = 7,
};

/// The one place of the operator's text for each step. Empty for a number that is none.
constexpr std::string_view operator_text(WorkStep step) {
  switch (step) {
    case WorkStep::None:
      return "waiting";
    case WorkStep::Record:
      return "recording pictures";
    case WorkStep::Detect:
      return "finding the ball";
    case WorkStep::Features:
      return "matching features";
    case WorkStep::Light:
      return "matching the process' light";
    case WorkStep::Edges:
      return "matching edges";
    case WorkStep::Tags:
      return "finding tags";
    case WorkStep::Solve:
      return "computing the position";
  }
  return {};
}

/// Lets a user follow and cancel work that takes seconds. Reentrant.
class WorkProgress {
 public:
  /// `share` of the step that is done: 0 to 1. Called on the thread of the work.
  using OnStep = std::function<void(WorkStep step, double share)>;

  /// Progress without an observer.
  WorkProgress() = default;
  explicit WorkProgress(OnStep on_step, std::stop_token stop = {})
      : on_step_(std::move(on_step)), stop_(std::move(stop)) {}

  /// Tells that a step begins or advances. Error: the work is cancelled, and is to end.
  Result<> at(WorkStep step, double share = 0) const {
    if (stop_.stop_requested()) return fail("cancelled");
    if (on_step_) on_step_(step, share);
    return {};
  }

  /// For waits that a cancellation ends.
  const std::stop_token& stop() const { return stop_; }

 private:
  OnStep on_step_;
  std::stop_token stop_;
};

}  // namespace orbwatch::align
