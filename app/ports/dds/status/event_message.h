// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/status/alarm_notice.h"
#include "app/ports/dds/generated/event.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/status/process_state.h"

namespace orbwatch::app::dds {

using EventMessage = orbwatch_msgs_msg_dds__Event_;

/// Converts a notice to the message of the event topic. Thread-bound; reuses its memory.
class EventComposer {
 public:
  /// The message; valid until the next call, and as long as the names. `stamp` is that of the
  /// notice in UTC. Its figures are its notice_readings().
  const EventMessage& compose(const AlarmNotice& notice, const StatusNames& names,
                              const TimeMessage& stamp);

 private:
  std::string source_, text_;
  std::vector<FigureMessage> figures_;
  EventMessage message_{};
};

}  // namespace orbwatch::app::dds
