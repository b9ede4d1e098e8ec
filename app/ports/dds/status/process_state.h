// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "app/model/status/readings.h"
#include "app/ports/dds/generated/process_state.h"
#include "app/ports/dds/status/dds_statistics.h"

namespace orbwatch::app::dds {

using FigureMessage = orbwatch_msgs_msg_dds__Figure_;
using FigureSequence = dds_sequence_orbwatch_msgs_msg_dds__Figure_;
using ComponentMessage = orbwatch_msgs_msg_dds__Component_;
using ProcessStateMessage = orbwatch_msgs_msg_dds__ProcessState_;

/// Kind of the component that this port adds to those of a status.
inline constexpr std::string_view kCommandsKind = "commands";

/// A reading as a message. It refers to the reading's texts, which are zero-terminated or empty and
/// outlive it.
FigureMessage figure_message(const Reading& reading);

/// Converts a status to the message of the process-state topic. Thread-bound; reuses its memory.
class ProcessStateComposer {
 public:
  /// The message; valid until the next call, and as long as the names of the report.
  const ProcessStateMessage& compose(const StatusReport& report, const CommandCounts& commands);

 private:
  std::vector<ComponentReadings> parts_;
  std::vector<FigureMessage> figures_;
  std::vector<ComponentMessage> components_;
  ProcessStateMessage message_{};
};

}  // namespace orbwatch::app::dds
