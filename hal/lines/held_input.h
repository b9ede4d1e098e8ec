// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "hal/lines/line.h"
#include "hal/lines/line_task.h"
#include "hal/lines/process_input.h"

namespace orbwatch::hal {

/// Detects that an input is held active for a time, each time that it becomes active. An input that
/// is active from the start on must become inactive first: a stuck or broken wire must not act.
/// Thread rule: thread-bound (the line thread).
class HeldInput : public LineTask {
 public:
  /// `state` is that of the input whose edges on_edge() receives. `on_held` must not wait.
  HeldInput(Clock::duration hold, std::shared_ptr<const ProcessInput> state,
            std::function<void()> on_held);

  void on_edge(const EdgeEvent& edge);

  TimePoint due() const override;
  void run(TimePoint now) override;

 private:
  const Clock::duration hold_;
  const std::shared_ptr<const ProcessInput> state_;
  const std::function<void()> on_held_;
  std::optional<TimePoint> since_;  ///< moment of the edge that may lead to a request
};

}  // namespace orbwatch::hal
