// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/held_input.h"

#include <utility>

namespace orbwatch::hal {

HeldInput::HeldInput(Clock::duration hold, std::shared_ptr<const ProcessInput> state,
                     std::function<void()> on_held)
    : hold_(hold), state_(std::move(state)), on_held_(std::move(on_held)) {}

void HeldInput::on_edge(const EdgeEvent& edge) {
  if (edge.edge == Edge::Rising) {
    since_ = edge.stamp;
  } else {
    since_.reset();
  }
}

TimePoint HeldInput::due() const { return since_ ? *since_ + hold_ : TimePoint::max(); }

void HeldInput::run(TimePoint now) {
  if (now < due()) return;
  // The level is unknown while the line has a fault: the time begins again, until it returns.
  const bool is_known = state_->active().has_value();
  since_ = is_known ? std::nullopt : std::optional(now);
  if (is_known && *state_->active()) on_held_();
}

}  // namespace orbwatch::hal
